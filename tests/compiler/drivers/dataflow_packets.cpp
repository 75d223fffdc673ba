#include "../drive.hpp"
namespace kernel_dataflow_packets {
#include "../kernels/dataflow_packets.cpp"
}
using namespace kernel_dataflow_packets;

EPILINE_DRIVER(dataflow_packets) {
  auto& in = s.input<beat_t>("in");
  auto& out = s.output<beat_t>("out");
  for (const int length : {1, 2, 60, 3, 1, 17}) {
    std::vector<unsigned> wanted;
    unsigned key = 0;
    unsigned sum = 0;
    for (int i = 0; i < length; ++i) {
      beat_t b = s.any<beat_t>();
      b.last = i + 1 == length;
      in.push(b);
      const unsigned data = b.data.to_uint();
      if (i == 0) key = data & 0xff;
      wanted.push_back(data ^ key * 0x10101u);
      key = ((key << 1) | ((key >> 7 ^ key >> 5 ^ key >> 4 ^ key >> 3) & 1)) & 0xff;
      sum ^= wanted.back();
      sum = ((sum << 1) | (sum >> 23)) & 0xffffff;
    }
    wanted.push_back(sum);
    dataflow_packets(in.stream, out.stream);
    std::vector<unsigned> found;
    for (const beat_t& b : out.drain()) {
      found.push_back(b.data.to_uint());
      s.expect(b.last == (static_cast<int>(found.size()) == length + 1), "last");
    }
    s.expect_equal(found, wanted, "beats");
  }
}
