#include "../drive.hpp"
namespace kernel_dataflow_balanced {
#include "../kernels/dataflow_balanced.cpp"
}
using namespace kernel_dataflow_balanced;

EPILINE_DRIVER(dataflow_balanced) {
  auto& in = s.input<value_t>("in");
  auto& out = s.output<ap_uint<17>>("out");
  // So many that the bound of clocks would be broken by far if the ways were not balanced.
  for (int i = 0; i < 800; ++i) {
    const value_t v = s.any<value_t>();
    in.push(v);
    dataflow_balanced(in.stream, out.stream);
    const auto found = out.drain();
    s.expect(found.size() == 1 && found[0] == v.to_uint() + 50000 / (v.to_uint() | 1), "sum");
  }
}
