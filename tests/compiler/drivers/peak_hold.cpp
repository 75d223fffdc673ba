#include "../drive.hpp"
namespace kernel_peak_hold {
#include "../kernels/peak_hold.cpp"
}
using namespace kernel_peak_hold;

EPILINE_LEAVES(sample_t, v.channel, v.value);
EPILINE_DRIVER(peak_hold) {
  auto& samples = s.input<sample_t>("samples");
  auto& peaks = s.output<ap_int<10>>("peaks");
  int peak[64] = {};
  std::vector<int> wanted;
  for (int i = 0; i < 300; ++i) {
    sample_t sample = s.any<sample_t>();
    if (s.chance(70)) sample.channel = int(s.number(0, 2));  // the same channel again before the pipeline has drained
    samples.push(sample);
    int& mine = peak[sample.channel.to_uint()];
    wanted.push_back(mine);
    mine = std::max(mine, int(sample.value));
    peak_hold(samples.stream, peaks.stream);
  }
  s.expect_equal(peaks.drain(), wanted, "peaks");
}
