#include "../drive.hpp"
namespace regression_unrolled_once {
#include "../regressions/unrolled_once.cpp"
}

EPILINE_DRIVER(unrolled_once) {
  auto& in = s.input<ap_uint<16>>("in");
  auto& out = s.output<ap_uint<20>>("out");
  for (int rows = 0; rows < 5; ++rows) {
    for (int i = 0; i < 4 * rows; ++i) in.push(s.any<ap_uint<16>>());
    s.call({{"rows", rows}});
    regression_unrolled_once::unrolled_once(in.stream, out.stream, rows);
  }
}
