#include "../drive.hpp"
namespace kernel_run_length {
#include "../kernels/run_length.cpp"
}
using namespace kernel_run_length;

EPILINE_DRIVER(run_length) {
  auto& in = s.input<in_pkt>("A");
  auto& out = s.output<out_pkt>("B");
  for (const int length : {50, 1, 2, 700, 30}) {
    std::vector<int> values;
    int value = 0;
    for (int i = 0; i < length; ++i) {
      if (s.chance(length == 700 ? 1 : 40)) value = int(s.number(0, 65535));
      values.push_back(value);
      in_pkt beat = s.any<in_pkt>();
      beat.data = value;
      beat.last = i + 1 == length;
      in.push(beat);
    }
    run_length(in.stream, out.stream);
    std::vector<int> found;
    const auto pairs = out.drain();
    for (const out_pkt& pair : pairs)
      found.insert(found.end(), pair.data.range(23, 16).to_uint(), int(pair.data.range(15, 0)));
    s.expect_equal(found, values, "expanded");
    s.expect(!pairs.empty() && pairs.back().last, "the last pair ends the packet");
  }
}
