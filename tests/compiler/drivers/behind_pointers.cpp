#include <ap_fixed.h>

#include "../drive.hpp"
namespace regression_behind_pointers {
#include "../regressions/behind_pointers.cpp"
struct raw_taps_t {
  ap_int<12> v[taps];
};
}  // namespace regression_behind_pointers
using namespace regression_behind_pointers;
EPILINE_LEAVES(limits_t, v.low, v.high);
EPILINE_LEAVES(raw_taps_t, v.v[0], v.v[1], v.v[2], v.v[3], v.v[4]);
struct more_t {
  short v[2][2];
};
EPILINE_LEAVES(more_t, v.v[0][0], v.v[0][1], v.v[1][0], v.v[1][1]);
struct extremes_t {
  ap_int<20> v[2];
};
EPILINE_LEAVES(extremes_t, v.v[0], v.v[1]);

EPILINE_DRIVER(behind_pointers) {
  auto& in = s.input<ap_int<12>>("in");
  auto& out = s.output<ap_int<20>>("out");
  for (const int length : {10, 0, 1, 40}) {
    tap_t coefficients[taps];
    raw_taps_t raw;
    for (int k = 0; k < taps; ++k) {
      raw.v[k] = s.any<ap_int<12>>();
      coefficients[k].range() = raw.v[k];
    }
    more_t more;
    for (int i = 0; i < 4; ++i) more.v[i / 2][i % 2] = short(s.number(0, 200) - 100);
    limits_t limits;
    limits.low = -int(s.number(0, 2000));
    limits.high = int(s.number(0, 2000));
    ap_uint<8> count = length;
    std::vector<int> values;
    std::vector<ap_int<20>> wanted;
    unsigned changed = 0;
    int least = 0, most = 0;
    for (int i = 0; i < length; ++i) {
      const ap_int<12> value = s.any<ap_int<12>>();
      in.push(value);
      values.push_back(value.to_int());
      int sum = 0;
      for (int k = 0; k < taps && k <= i; ++k) sum += values[std::size_t(i - k)] * raw.v[k].to_int();
      // A product is cut to the bits of the sum, 10 behind the point as the taps have; only the integer is given.
      const int whole = (sum < 0 ? -(-sum / 1024) : sum / 1024) + more.v[i % 2][i / 2 % 2];
      least = std::min(least, whole);
      most = std::max(most, whole);
      const int inside = std::clamp(whole, limits.low.to_int(), limits.high.to_int());
      changed += inside != whole;
      wanted.push_back(ap_int<20>(inside));
    }
    s.call({{"coefficients", raw}, {"more", more}, {"limits", limits}, {"count", count}});
    unsigned clipped = 99;
    extremes_t extremes = {{5, 5}};
    bool any = false;
    behind_pointers(in.stream, out.stream, coefficients, more.v, limits, &count, &clipped, extremes.v, &any);
    s.result("clipped", clipped);
    s.result("extremes", extremes);
    s.result("any", ap_uint<1>(any));
    s.expect(clipped == changed && any == (length != 0) && extremes.v[0] == least && extremes.v[1] == most, "results");
    s.expect_equal(out.drain(), wanted, "out");
  }
}
