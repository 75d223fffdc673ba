#include "../drive.hpp"
namespace regression_partial_unroll {
#include "../regressions/partial_unroll.cpp"
}

EPILINE_DRIVER(partial_unroll) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<16>>("out");
  for (const int count : {0, 1, 3, 4, 5, 8, 61}) {
    std::vector<unsigned> values;
    for (int i = 0; i < 11; ++i) {
      const ap_uint<8> value = i == 4 ? 3 : s.number(4, 120);
      in.push(value);
      if (i < 10) values.push_back(value.to_uint());
    }
    for (unsigned i = 10; i < 64; ++i) values.push_back(i * 3);
    unsigned sum = 0;
    for (int i = 0; i < count; ++i) sum += values[std::size_t(i)];
    unsigned first = 0xffff;
    for (unsigned i = 50; i-- > 0;)
      if (values[i] > 100) first = i;
    s.call({{"count", ap_uint<6>(count)}});
    regression_partial_unroll::partial_unroll(in.stream, out.stream, count);
    const auto found = out.drain();
    s.expect(found.size() >= 9 && found[0] == sum && found[1] == first, "sum and first");
  }
}
