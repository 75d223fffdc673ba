#include "../drive.hpp"
namespace kernel_fir {
#include "../kernels/fir.cpp"
}
using namespace kernel_fir;

EPILINE_DRIVER(fir) {
  auto& x = s.input<sample_t>("x");
  auto& y = s.output<sum_t>("y");
  std::vector<int> samples;
  std::vector<int> wanted;
  for (int n = 0; n < 300; ++n) {
    const sample_t sample = s.any<sample_t>();
    x.push(sample);
    samples.insert(samples.begin(), int(sample));
    int sum = 0;
    for (std::size_t i = 0; i < taps && i < samples.size(); ++i) sum += samples[i] * int(coefficients[i]);
    wanted.push_back(sum);
    fir(x.stream, y.stream);
  }
  s.expect_equal(y.drain(), wanted, "y");
}
