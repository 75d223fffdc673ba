#include <ap_fixed.h>

#include <algorithm>
#include <cmath>

#include "../drive.hpp"
namespace regression_fixed_point {
#include "../regressions/fixed_point.cpp"
}
using namespace regression_fixed_point;
EPILINE_LEAVES(sample_pair, v.left.V, v.gain.V);
EPILINE_LEAVES(result_t, v.V);

EPILINE_DRIVER(fixed_point) {
  auto& in = s.input<sample_pair>("in");
  auto& out = s.output<result_t>("out");
  auto& modes = s.output<ap_int<24>>("modes");
  double kept[2] = {0, 0};
  const double window[8] = {0.0, 0.19, 0.61, 0.95, 0.95, 0.61, 0.19, -0.5};
  for (int i = 0; i < 300; ++i) {
    const sample_pair pair = s.any<sample_pair>();
    in.push(pair);
    fixed_point(in.stream, out.stream, modes.stream);
    const double a1 = std::floor(-0.4 * 16384) / 16384;
    const double w = pair.left.to_double() * std::floor(window[i % 8] * 512) / 512 - a1 * kept[0] -
                     std::floor(kept[1] / 4 * 32768) / 32768;
    const double cut = std::floor(w * 32768) / 32768;
    const double y = 0.25 * cut + kept[0] * 0.5 + kept[1] * 0.25;
    kept[1] = kept[0];
    kept[0] = cut;
    const double wanted = std::min(std::floor(y * 1024 + 0.5), 2047.0) / 1024;
    for (const result_t& found : out.drain()) s.expect(found.to_double() == std::max(wanted, -2.0), "biquad");
  }
  modes.drain();
}
