#include "../drive.hpp"
namespace regression_table_of_bits {
#include "../regressions/table_of_bits.cpp"
}

EPILINE_DRIVER(table_of_bits) {
  auto& index = s.input<ap_uint<3>>("index");
  auto& bit = s.output<ap_uint<1>>("bit");
  for (int i = 0; i < 24; ++i) {
    index.push(i % 8);
    regression_table_of_bits::table_of_bits(index.stream, bit.stream);
  }
}
