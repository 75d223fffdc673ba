#include "../drive.hpp"
namespace kernel_moving_median {
#include "../kernels/moving_median.cpp"
}
using namespace kernel_moving_median;

EPILINE_DRIVER(moving_median) {
  auto& in = s.input<data_t>("in");
  auto& out = s.output<data_t>("out");
  std::vector<int> samples(8, 0), wanted;  // zeros before the first sample
  for (int i = 0; i < 300; ++i) {
    const data_t x = i % 100 < 30 ? data_t(s.number(-2, 2)) : s.any<data_t>();  // often equal, or anything
    samples.push_back(int(x));
    in.push(x);
    moving_median(in.stream, out.stream);
    std::vector<int> window(samples.end() - 9, samples.end());
    std::sort(window.begin(), window.end());
    wanted.push_back(window[4]);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
