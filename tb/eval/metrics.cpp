#include "eval/metrics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace epiline::eval {
namespace {

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

template <class Map>
void require_size(std::string_view what, int width, int height, const Map& map) {
  if (width == map.width && height == map.height) return;
  throw std::invalid_argument(
      fmt::format("{} is {}x{}, but the disparity map is {}x{}", what, width, height, map.width, map.height));
}

void count(accuracy_counts& counts, double disparity, double truth) {
  ++counts.known;
  if (!std::isfinite(disparity)) return;
  ++counts.defined;
  const double error = std::abs(disparity - truth);
  counts.error_sum += error;
  counts.correct += error <= 1 ? 1 : 0;
  counts.bad_half += error > 0.5 ? 1 : 0;
  counts.bad_one += error > 1 ? 1 : 0;
  counts.bad_two += error > 2 ? 1 : 0;
}

}  // namespace

double accuracy_counts::coverage() const { return share(defined, known); }
double accuracy_counts::accuracy() const { return share(correct, defined); }
double accuracy_counts::bad_half_share() const { return share(bad_half, defined); }
double accuracy_counts::bad_one_share() const { return share(bad_one, defined); }
double accuracy_counts::bad_two_share() const { return share(bad_two, defined); }
double accuracy_counts::bad_one_undefined_share() const { return share(bad_one + known - defined, known); }
double accuracy_counts::average_error() const { return defined == 0 ? 0 : error_sum / static_cast<double>(defined); }

double map_figures::coverage() const { return share(defined, pixels); }

map_figures measure(const real_map& map, const ground_truth* truth) {
  map_figures figures;
  figures.pixels = map.values.size();
  for (const double disparity : map.values) figures.defined += std::isfinite(disparity) ? 1 : 0;
  if (truth == nullptr) return figures;

  require_size("the ground truth", truth->disparity.width, truth->disparity.height, map);
  if (truth->evaluated) require_size("the mask", truth->evaluated->width, truth->evaluated->height, map);
  struct region {
    std::string_view name;
    const std::optional<pixel_mask>& mask;
    std::optional<accuracy_counts>& counts;
  };
  const region regions[] = {
      {"the mask of non-occluded pixels", truth->non_occluded, figures.non_occluded},
      {"the mask of pixels near discontinuities", truth->near_discontinuity, figures.near_discontinuity},
  };
  for (const auto& [name, mask, counts] : regions) {
    if (!mask) continue;
    require_size(name, mask->width, mask->height, map);
    counts.emplace();
  }
  figures.all.emplace();
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const double expected = truth->disparity.values[i];
    if (!std::isfinite(expected) || (truth->evaluated && !truth->evaluated->selected[i])) continue;
    count(*figures.all, map.values[i], expected);
    for (const auto& [name, mask, counts] : regions) {
      if (mask && mask->selected[i]) count(*counts, map.values[i], expected);
    }
  }
  return figures;
}

map_figures measure(const disparity_map& map, const ground_truth* truth) { return measure(real_values_of(map), truth); }

map_difference compare(const disparity_map& a, const disparity_map& b) {
  require_size("the other map", b.width, b.height, a);
  map_difference difference;
  difference.pixels = a.defined.size();
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i = a.index(x, y);
      if (a.defined[i] == b.defined[i] && a.disparity[i] == b.disparity[i]) continue;
      if (difference.differing++ == 0) {
        difference.first_x = x;
        difference.first_y = y;
      }
    }
  }
  return difference;
}

}  // namespace epiline::eval
