#include "../drive.hpp"
namespace kernel_min_max {
#include "../kernels/min_max.cpp"
}
using namespace kernel_min_max;

EPILINE_LEAVES(extreme_t, v.value, v.position);
EPILINE_DRIVER(min_max) {
  auto& in = s.input<value_t>("in");
  auto& minimum = s.output<extreme_t>("minimum");
  auto& maximum = s.output<extreme_t>("maximum");
  for (const int length : {40, 1, 0, 300}) {
    int lowest = 8191, highest = -8192;
    std::int64_t sum = 0;
    for (int i = 0; i < length; ++i) {
      const value_t v = s.any<value_t>();
      in.push(v);
      lowest = std::min(lowest, int(v));
      highest = std::max(highest, int(v));
      sum += int(v);
    }
    s.call({{"length", ap_uint<10>(length)}});
    ap_int<24> total = 0;
    bool any_negative = false;
    min_max(in.stream, minimum.stream, maximum.stream, length, total, any_negative);
    s.result("total", total);
    s.result("any_negative", any_negative);
    const auto lows = minimum.drain();
    const auto highs = maximum.drain();
    s.expect(lows.size() == std::size_t(length) && highs.size() == std::size_t(length), "one of each a value");
    s.expect(length == 0 || (lows.back().value == lowest && highs.back().value == highest), "extremes");
    s.expect(total == sum, "total");
  }
}
