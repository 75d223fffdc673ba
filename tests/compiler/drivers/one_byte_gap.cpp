#include "../drive.hpp"
namespace regression_one_byte_gap {
#include "../regressions/one_byte_gap.cpp"
}
using namespace regression_one_byte_gap;

EPILINE_LEAVES(gap_t, v.address, v.high[0], v.high[1], v.flag, v.size, v.rest);
EPILINE_LEAVES(full_t, v.high, v.flag, v.size);
EPILINE_DRIVER(one_byte_gap) {
  auto& in = s.input<gap_t>("in");
  auto& out = s.output<full_t>("out");
  for (int i = 0; i < 100; ++i) {
    in.push(s.any<gap_t>());
    one_byte_gap(in.stream, out.stream);
  }
}
