#include "../drive.hpp"
namespace kernel_dataflow_gain {
#include "../kernels/dataflow_gain.cpp"
}
using namespace kernel_dataflow_gain;

EPILINE_DRIVER(dataflow_gain) {
  auto& in = s.input<beat_t>("in");
  auto& out = s.output<beat_t>("out");
  for (const int count : {1, 100, 2, 0, 37}) {
    const unsigned gain = static_cast<unsigned>(s.number(0, 255));
    const unsigned offset = static_cast<unsigned>(s.number(0, 65535));
    std::vector<unsigned> wanted;
    for (int i = 0; i < count; ++i) {
      const beat_t beat = s.any<beat_t>();
      in.push(beat);
      wanted.push_back((((beat.data.to_uint() * gain) >> 4) + offset) & 0xffff);
    }
    s.call({{"count", ap_uint<12>(count)}, {"gain", ap_uint<8>(gain)}, {"offset", ap_uint<16>(offset)}});
    dataflow_gain(in.stream, out.stream, count, gain, offset);
    std::vector<unsigned> found;
    for (const beat_t& beat : out.drain()) {
      s.expect(beat.last == (static_cast<int>(found.size()) + 1 == count), "last");
      found.push_back(beat.data.to_uint());
    }
    s.expect_equal(found, wanted, "samples");
  }
}
