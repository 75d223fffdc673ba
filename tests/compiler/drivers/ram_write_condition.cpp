#include "../drive.hpp"
namespace regression_ram_write_condition {
#include "../regressions/ram_write_condition.cpp"
}

EPILINE_DRIVER(ram_write_condition) {
  auto& in = s.input<ap_uint<12>>("in");
  auto& out = s.output<ap_uint<6>>("out");
  for (int i = 0; i < 300; ++i) {
    in.push(s.chance(50) ? s.any<ap_uint<12>>() : ap_uint<12>(s.number(0, 3) * 64 + s.number(0, 3)));
    regression_ram_write_condition::ram_write_condition(in.stream, out.stream);
  }
}
