#include <algorithm>

#include "../drive.hpp"
namespace regression_loops_in_loops {
#include "../regressions/loops_in_loops.cpp"
}

EPILINE_DRIVER(loops_in_loops) {
  auto& in = s.input<ap_uint<16>>("in");
  auto& out = s.output<ap_uint<16>>("out");
  for (int call = 0; call < 3; ++call) {
    std::vector<unsigned> values, wanted;
    for (int i = 0; i < 32; ++i) {
      const ap_uint<16> value = s.any<ap_uint<16>>();
      in.push(value);
      values.push_back(value.to_uint());
    }
    std::sort(values.begin(), values.end());
    for (std::size_t row = 0; row < 8; ++row)
      for (std::size_t column = 0; column < 8; ++column) {
        unsigned sum = 0;
        for (std::size_t k = 0; k < 4; ++k) sum += values[row * 4 + k] * values[k * 8 + column];
        wanted.push_back((sum + values[row]) & 0xffff);
      }
    regression_loops_in_loops::loops_in_loops(in.stream, out.stream);
    s.expect_equal(out.drain(), wanted, "out");
  }
}
