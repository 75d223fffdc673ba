#include "../drive.hpp"
namespace kernel_dataflow_reconvergent {
#include "../kernels/dataflow_reconvergent.cpp"
}
using namespace kernel_dataflow_reconvergent;
EPILINE_LEAVES(pixel_t, v.level, v.change);

EPILINE_DRIVER(dataflow_reconvergent) {
  auto& in = s.input<pixel_t>("in");
  auto& out = s.output<ap_int<18>>("out");
  for (const int count : {200, 1, 0, 63, 4}) {
    std::vector<int> wanted;
    bool mark = false;
    for (int i = 0; i < count; ++i) {
      const pixel_t p = s.any<pixel_t>();
      in.push(p);
      const int level = p.level.to_int();
      const int change = p.change.to_int();
      if (i % 2 == 0) mark = change < 0;
      const int quotient = change * 256 / (level + 1);
      wanted.push_back(mark ? quotient - level : quotient + level);
    }
    s.call({{"count", ap_uint<10>(count)}});
    dataflow_reconvergent(in.stream, out.stream, count);
    std::vector<int> found;
    for (const ap_int<18>& value : out.drain()) found.push_back(value.to_int());
    s.expect_equal(found, wanted, "values");
  }
}
