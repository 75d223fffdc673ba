#include "../drive.hpp"
namespace kernel_udp_filter {
#include "../kernels/udp_filter.cpp"
}
using namespace kernel_udp_filter;

// Frames made byte by byte: datagrams to the port and to another, other protocols, headers with a wrong checksum,
// padding of short frames, payloads of every length.
EPILINE_DRIVER(udp_filter) {
  auto& rx = s.input<word_t>("rx");
  auto& payload = s.output<word_t>("payload");
  std::vector<std::vector<int>> wanted;
  for (const int frames : {12, 0, 1, 40}) {
    const int port = int(s.number(1, 65535));
    unsigned accepted = 0, bad_checksum = 0;
    for (int n = 0; n < frames; ++n) {
      const bool other_port = s.chance(15), not_udp = s.chance(15), not_ip = s.chance(10), wrong_sum = s.chance(15);
      const int length = n < 20 ? n + 1 : int(s.number(1, 60));
      std::vector<int> frame;
      for (int i = 0; i < 12; ++i) frame.push_back(int(s.number(0, 255)));
      const auto pair = [&](int value) {
        frame.push_back(value >> 8 & 255);
        frame.push_back(value & 255);
      };
      pair(not_ip ? 0x86dd : 0x0800);
      const int words[10] = {0x4500,
                             28 + length,
                             int(s.number(0, 65535)),
                             0x4000,
                             64 << 8 | (not_udp ? 6 : 17),
                             0,
                             int(s.number(0, 65535)),
                             int(s.number(0, 65535)),
                             int(s.number(0, 65535)),
                             0xfffe};
      int sum = wrong_sum ? 1 : 0;
      for (const int word : words) sum += word;
      while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
      for (int i = 0; i < 10; ++i) pair(i == 5 ? 0xffff - sum : words[i]);
      pair(int(s.number(0, 65535)));
      pair(other_port ? port ^ 1 : port);
      pair(8 + length);
      pair(0);
      std::vector<int> body;
      for (int i = 0; i < length; ++i) body.push_back(int(s.number(0, 255)));
      frame.insert(frame.end(), body.begin(), body.end());
      while (frame.size() < 60) frame.push_back(0);
      for (std::size_t i = 0; i < frame.size(); i += 8) {
        word_t w = s.any<word_t>();
        w.data = 0;
        w.keep = 0;
        for (std::size_t b = 0; b < 8 && i + b < frame.size(); ++b) {
          w.data.range(int(8 * b + 7), int(8 * b)) = frame[i + b];
          w.keep[int(b)] = 1;
        }
        w.last = i + 8 >= frame.size();
        rx.push(w);
      }
      if (other_port || not_udp || not_ip) continue;
      if (wrong_sum) {
        ++bad_checksum;
        continue;
      }
      ++accepted;
      wanted.push_back(body);
    }
    // An ethernet type, a port or a protocol alone do not make a wrong checksum count.
    ap_uint<16> accepted_found, bad_found;
    s.call({{"port", ap_uint<16>(port)}, {"frames", ap_uint<16>(frames)}});
    udp_filter(rx.stream, payload.stream, port, frames, accepted_found, bad_found);
    s.result("accepted", accepted_found);
    s.result("bad_checksum", bad_found);
    s.expect(accepted_found == accepted, "accepted");
    s.expect(bad_found == bad_checksum, "bad_checksum");
  }
  std::vector<std::vector<int>> found(1);
  for (const word_t& w : payload.drain()) {
    for (int b = 0; b < 8; ++b) {
      if (w.keep[b]) found.back().push_back(int(w.data.range(8 * b + 7, 8 * b)));
    }
    if (w.last) found.emplace_back();
  }
  found.pop_back();
  s.expect_equal(found, wanted, "payload");
}
