#include "../drive.hpp"
namespace regression_dataflow_shared {
#include "../regressions/dataflow_shared.cpp"
}

EPILINE_DRIVER(dataflow_shared) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_int<32>>("out");
  for (const int frames : {1, 3, 0, 2}) {
    std::vector<int> wanted;
    for (int frame = 0; frame < frames; ++frame) {
      const int count = static_cast<int>(s.number(0, 30)), rows = static_cast<int>(s.number(0, 31));
      in.push(ap_uint<8>(count));
      in.push(ap_uint<8>(rows));
      int sum = 0;
      std::vector<int> values, table;
      for (int i = 0; i < 20; ++i) table.push_back(i * i);
      for (int i = 0; i < count; ++i) {
        const ap_uint<8> value = s.any<ap_uint<8>>();
        in.push(value);
        values.push_back(value.to_int());
        sum += values.back();
        table[std::size_t(values.back() % 20)] = sum;
      }
      wanted.push_back(sum + rows * ((count + 1) & 31));
      for (const int value : values) wanted.push_back(value + sum);
      for (std::size_t i = 20; i-- > 0;) wanted.push_back(table[i]);
    }
    s.call({{"frames", ap_uint<2>(frames)}});
    regression_dataflow_shared::dataflow_shared(in.stream, out.stream, frames);
    s.expect_equal(out.drain(), wanted, "out");
  }
}
