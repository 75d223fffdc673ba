#include "scenes/texture.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/noise.hpp"

namespace epiline::scenes {
namespace {

/// Smooth noise between -1 and 1: random values at integer positions, blended. `period` 0: none.
colour smooth_noise(std::uint64_t seed, double u, double v, std::int64_t period) {
  const double left = std::floor(u);
  const double top = std::floor(v);
  const auto blend = [](double t) { return t * t * (3 - 2 * t); };
  const double right_share = blend(u - left);
  const double bottom_share = blend(v - top);
  const auto knot = [&](int right, int down) {
    std::int64_t column = static_cast<std::int64_t>(left) + right;
    if (period != 0) column = (column % period + period) % period;
    const std::uint64_t bits = hash(seed, {column, static_cast<std::int64_t>(top) + down});
    const auto part = [bits](int k) { return static_cast<double>((bits >> (20 * k)) & 0xfffff) * 0x1p-19 - 1; };
    // Mostly brighter and darker, as things are; a little of each colour of its own.
    return colour(0.75 * colour::Constant(part(0)) + 0.25 * colour(part(0), part(1), part(2)));
  };
  const colour above = knot(0, 0) * (1 - right_share) + knot(1, 0) * right_share;
  const colour below = knot(0, 1) * (1 - right_share) + knot(1, 1) * right_share;
  return above * (1 - bottom_share) + below * bottom_share;
}

}  // namespace

colour texture::at(double u, double v, double pixels_per_unit) const {
  if (form == kind::plain) return base;
  const auto square = [](double position) { return static_cast<std::int64_t>(std::floor(position + 0.5)); };
  if (form == kind::dots) return colour::Constant(hash(seed, {square(u), square(v)}) >> 63 != 0 ? 255 : 0);
  if (form == kind::specks) {
    const std::uint64_t bits = hash(seed, {square(u), square(v)});
    return base + (between(bits, 0, 19) == 0 ? between(hash(bits, {}), -1, 1) * contrast : 0.0);
  }
  colour sum = base;
  double wave = longest_wave;
  for (int k = 0; k < waves; ++k, wave /= 2) {
    const double shown = std::clamp(wave * pixels_per_unit - 1, 0.0, 1.0);  // 1 from two pixels a wave up
    if (shown == 0) break;
    const auto knots = form == kind::repeated ? std::max<std::int64_t>(std::llround(period / wave), 1) : 0;
    const double spacing = form == kind::repeated ? static_cast<double>(period) / static_cast<double>(knots) : wave;
    sum += contrast * shown * smooth_noise(hash(seed, {k}), u / spacing, v / wave, knots);
  }
  return sum;
}

}  // namespace epiline::scenes
