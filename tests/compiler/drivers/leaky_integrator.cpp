#include "../drive.hpp"
namespace kernel_leaky_integrator {
#include "../kernels/leaky_integrator.cpp"
}
using namespace kernel_leaky_integrator;

EPILINE_DRIVER(leaky_integrator) {
  auto& x = s.input<ap_int<16>>("x");
  auto& y = s.output<ap_int<16>>("y");
  for (const int samples : {100, 0, 1, 77}) {
    const auto start = static_cast<short>(s.number(-32768, 32767));
    s.call({{"samples", samples}, {"start", start}});
    std::vector<int> wanted;
    int state = start * 16;
    for (int i = 0; i < samples; ++i) {
      const ap_int<16> value = s.any<ap_int<16>>();
      x.push(value);
      state += (int(value) * 16 - state) >> 4;
      wanted.push_back(state >> 4);
    }
    leaky_integrator(x.stream, y.stream, samples, start);
    s.expect_equal(y.drain(), wanted, "y");
  }
}
