#include "../drive.hpp"
namespace kernel_dataflow_twice {
#include "../kernels/dataflow_twice.cpp"
}
using namespace kernel_dataflow_twice;

EPILINE_DRIVER(dataflow_twice) {
  auto& in = s.input<value_t>("in");
  auto& out = s.output<value_t>("out");
  const int sizes[][2] = {{3, 5}, {1, 1}, {0, 9}, {31, 4}, {2, 2}};
  for (const auto& size : sizes) {
    const unsigned amount = static_cast<unsigned>(s.number(0, 4095));
    const unsigned half = amount > 100 ? amount / 2 : amount;
    unsigned sums[3] = {half, half + 1, 7};
    unsigned most = 0;
    std::vector<unsigned> wanted;
    for (int i = 0; i < size[0] * size[1]; ++i) {
      const value_t v = s.any<value_t>();
      in.push(v);
      unsigned value = v.to_uint();
      for (unsigned& sum : sums) value = sum = (sum + value) & 0xfff;
      most = std::max(most, value);
      wanted.push_back(value);
    }
    s.call({{"rows", ap_uint<5>(size[0])}, {"columns", ap_uint<5>(size[1])}, {"amount", ap_uint<12>(amount)}});
    ap_uint<12> largest = 0;
    dataflow_twice(in.stream, out.stream, size[0], size[1], amount, largest);
    s.result("largest", largest);
    s.expect(largest == most, "largest");
    std::vector<unsigned> found;
    for (const value_t& value : out.drain()) found.push_back(value.to_uint());
    s.expect_equal(found, wanted, "values");
  }
}
