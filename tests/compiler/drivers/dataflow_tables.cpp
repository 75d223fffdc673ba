#include "../drive.hpp"
namespace regression_dataflow_tables {
#include "../regressions/dataflow_tables.cpp"
}

EPILINE_DRIVER(dataflow_tables) {
  auto& in = s.input<ap_uint<6>>("in");
  auto& out = s.output<ap_int<20>>("out");
  for (int call = 0; call < 20; ++call) {
    for (int i = 0; i < 4; ++i) in.push(s.number(0, 63));
    regression_dataflow_tables::dataflow_tables(in.stream, out.stream);
  }
  s.expect(out.drain().size() == 80, "number of words");
}
