#include "../drive.hpp"
namespace kernel_packet_parser {
#include "../kernels/packet_parser.cpp"
}
using namespace kernel_packet_parser;

EPILINE_LEAVES(payload_t, v.byte, v.kind, v.first);
EPILINE_LEAVES(verdict_t, v.kind, v.length, v.good);
EPILINE_DRIVER(packet_parser) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& payload = s.output<payload_t>("payload");
  auto& verdict = s.output<verdict_t>("verdict");
  std::size_t good = 0, bytes = 0, packets = 0;
  for (int packet = 0; packet < 40; ++packet) {
    for (auto noise = s.number(0, 3); noise > 0; --noise) in.push(s.number(0, 0x54));
    in.push(0x55);
    const int kind = int(s.number(0, 255));
    const int length = int(s.chance(20) ? 0 : s.number(1, 20));
    int sum = kind + length;
    in.push(kind);
    in.push(length);
    for (int i = 0; i < length; ++i) {
      const int byte = int(s.number(0, 255));
      in.push(byte);
      sum += byte;
    }
    const bool broken = s.chance(20);
    in.push((sum + (broken ? 1 : 0)) & 255);
    good += !broken;
    bytes += std::size_t(length);
    ++packets;
  }
  while (!in.stream.empty()) packet_parser(in.stream, payload.stream, verdict.stream);
  s.expect(payload.drain().size() == bytes, "every payload byte once");
  std::size_t found = 0;
  const auto verdicts = verdict.drain();
  for (const verdict_t& v : verdicts) found += v.good;
  s.expect(verdicts.size() == packets && found == good, "verdicts");
}
