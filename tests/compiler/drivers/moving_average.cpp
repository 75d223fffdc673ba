#include "../drive.hpp"
namespace kernel_moving_average {
#include "../kernels/moving_average.cpp"
}
using namespace kernel_moving_average;

EPILINE_DRIVER(moving_average) {
  auto& din = s.input<ap_uint<12>>("din");
  auto& dout = s.output<ap_uint<12>>("dout");
  std::vector<int> values, wanted;
  for (int n = 0; n < 200; ++n) {
    const ap_uint<12> x = s.any<ap_uint<12>>();
    din.push(x);
    values.push_back(int(x));
    int sum = 0;
    for (std::size_t i = values.size() > 32 ? values.size() - 32 : 0; i < values.size(); ++i) sum += values[i];
    wanted.push_back(sum / 32);
    moving_average(din.stream, dout.stream);
  }
  s.expect_equal(dout.drain(), wanted, "dout");
}
