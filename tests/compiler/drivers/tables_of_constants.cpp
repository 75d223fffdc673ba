#include <cmath>

#include "../drive.hpp"
#include "ap_fixed.h"
namespace regression_tables_of_constants {
#include "../regressions/tables_of_constants.cpp"
}

EPILINE_DRIVER(tables_of_constants) {
  auto& in = s.input<ap_uint<12>>("in");
  auto& out = s.output<ap_int<40>>("out");
  for (int call = 0; call < 40; ++call) {
    for (int i = 0; i < 16; ++i) in.push(s.number(0, 4095));
    regression_tables_of_constants::tables_of_constants(in.stream, out.stream);
  }
  s.expect(out.drain().size() == 40 * 16, "number of words");
}
