#include <ap_shift_reg.h>

#include "../drive.hpp"
namespace kernel_shift_register_fir {
#include "../kernels/shift_register_fir.cpp"
}
using namespace kernel_shift_register_fir;

EPILINE_DRIVER(shift_register_fir) {
  auto& x = s.input<sample_t>("x");
  auto& y = s.output<ap_int<16>>("y");
  const int weights[] = {-3, 11, 45, 75, 75, 45, 11, -3};
  std::vector<int> samples(8, 0), filtered(100, 0), wanted;
  for (int call = 0; call < 20; ++call) {
    const int echo = call % 4 == 3 ? 100 + call : static_cast<int>(s.number(0, 99));
    for (int n = 0; n < 16; ++n) {
      const sample_t sample = s.any<sample_t>();
      x.push(sample);
      samples.insert(samples.begin(), int(sample));
      int sum = 0;
      for (std::size_t i = 0; i < 8; ++i) sum += samples[i] * weights[i];
      const int now = sum >> 6;  // of 24 bits: no sample makes it wrap
      // The register tells what stood there before the newest came in.
      wanted.push_back(now + (filtered[static_cast<std::size_t>(echo < 100 ? echo : 0)] >> 1));
      filtered.insert(filtered.begin(), now);
    }
    s.call({{"echo", ap_uint<7>(echo)}});
    shift_register_fir(x.stream, y.stream, ap_uint<7>(echo));
  }
  s.expect_equal(y.drain(), wanted, "y");
}
