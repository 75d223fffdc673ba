#include "scenes/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace epiline::scenes {

colour surface::colour_at(position in_left) const {
  if (laid == mapping::image) return colours.at(in_left.x, in_left.y, 1);
  const double near = std::max(disparity(in_left), 1e-3);
  const double magnification = near / unit_disparity;  // pixels a unit, across the line of sight
  const double across = (in_left.x - centre.x) / magnification;
  const double upwards = (in_left.y - centre.y) / magnification;
  const double away = focal_length / magnification;
  // Seen at a slant, a unit of depth takes fewer pixels than one across. The texture is stretched along the line of
  // sight, as planks on a floor are, and its waves fade by the mean of both sizes.
  constexpr double stretch = 8;
  const auto size = [&](double slope) {
    const double unit_of_depth = magnification * near / (focal_length * std::abs(slope));
    return std::sqrt(magnification * std::min(magnification, stretch * unit_of_depth));
  };
  switch (laid) {
    case mapping::along_floor:
      return colours.at(across, away / stretch, size(per_row));
    case mapping::along_wall:
      return colours.at(away / stretch, upwards, size(per_column));
    default:
      return colours.at(across, upwards, magnification);
  }
}

std::vector<const surface*> room::surfaces_of_row(double y) const {
  std::vector<const surface*> crossing;
  for (const surface& candidate : surfaces_) {
    if (candidate.top <= y && y < candidate.bottom) crossing.push_back(&candidate);
  }
  return crossing;
}

sighting room::nearest(const std::vector<const surface*>& surfaces, camera by, position at) {
  sighting best{nullptr, at, 0};
  for (const surface* candidate : surfaces) {
    const position in_left = candidate->left_position(by, at);
    if (!candidate->covers(in_left)) continue;
    const double disparity = candidate->disparity(in_left);
    if (best.seen == nullptr || disparity > best.disparity) best = {candidate, in_left, disparity};
  }
  if (best.seen == nullptr) throw std::logic_error("a scene without background");
  return best;
}

}  // namespace epiline::scenes
