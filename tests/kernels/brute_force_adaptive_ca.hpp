#pragma once
// Method 1 straight from the equations: whole images, every sum computed anew, the automaton on one binary plane a
// level. Slow, and nothing in it is shared with the kernels.

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "frame_harness.hpp"

namespace epiline::test {

inline int luma(const picture& picture, int x, int y) {
  return (picture.at(x, y, 0) + 2 * picture.at(x, y, 1) + picture.at(x, y, 2) + 2) / 4;
}

/// Sum of |n I - S| over the n pixels of columns x0 .. x1 and rows y0 .. y1, the border replicated.
inline int brute_force_variation(const picture& picture, int x0, int x1, int y0, int y1) {
  const auto pixel = [&](int x, int y) {
    return luma(picture, std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1));
  };
  int sum = 0;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) sum += pixel(x, y);
  }
  const int count = (x1 - x0 + 1) * (y1 - y0 + 1);
  int variation = 0;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) variation += std::abs(count * pixel(x, y) - sum);
  }
  return variation;
}

inline int brute_force_radius(const picture& left, int x, int y, int t2, int t5) {
  if (brute_force_variation(left, x, x + 1, y, y + 1) > 4 * t2) return 1;
  if (brute_force_variation(left, x - 2, x + 2, y - 2, y + 2) > 25 * t5) return 2;
  return 3;
}

inline int luma_cost(const stereo_pair& pair, int x, int y, int d, int radius) {
  int sum = 0;
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, pair.left.height - 1); ++v) {
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, pair.left.width - 1); ++u) {
      sum += std::abs(luma(pair.left, u, v) - luma(pair.right, std::max(u - d, 0), v));
    }
  }
  return sum;
}

/// One pass of rule 1, then of rule 2, on every level's binary plane, and the recomposition.
inline disparity_map brute_force_automaton(const disparity_map& map, int width, int height, int ring) {
  using plane = std::vector<bool>;
  const auto index = [width](int x, int y) { return static_cast<std::size_t>(y * width + x); };
  const auto is_set = [&](const plane& plane, int x, int y) {
    return x >= 0 && x < width && y >= 0 && y < height && plane[index(x, y)];
  };
  const auto set_within = [&](const plane& plane, int x, int y, int radius) {
    int count = 0;
    for (int v = y - radius; v <= y + radius; ++v) {
      for (int u = x - radius; u <= x + radius; ++u) count += is_set(plane, u, v);
    }
    return count;
  };
  constexpr int all_levels = 128;
  std::vector<plane> planes(all_levels, plane(map.size()));
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] != undefined) planes[static_cast<std::size_t>(map[i])][i] = true;
  }
  std::vector<plane> settled = planes;
  std::vector<int> born(map.size(), undefined);
  for (std::size_t level = 0; level < all_levels; ++level) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int neighbours = set_within(planes[level], x, y, 1) - (is_set(planes[level], x, y) ? 1 : 0);
        if (neighbours == 0) settled[level][index(x, y)] = false;
        if (neighbours >= 7) born[index(x, y)] = static_cast<int>(level);
      }
    }
  }
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (born[i] == undefined) continue;
    for (std::size_t level = 0; level < all_levels; ++level) settled[level][i] = static_cast<int>(level) == born[i];
  }
  disparity_map result(map.size(), undefined);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int claims = 0;
      int claimed = 0;
      for (std::size_t level = 0; level < all_levels; ++level) {
        const int near = set_within(settled[level], x, y, 1);
        const int around = set_within(settled[level], x, y, 3) - near;
        if (near < 1 || around < ring) continue;
        ++claims;
        claimed = static_cast<int>(level);
      }
      if (claims == 1) result[index(x, y)] = claimed;
    }
  }
  return result;
}

inline disparity_map brute_force_adaptive_ca(const stereo_pair& pair, const adaptive_ca_settings& with) {
  disparity_map map;
  for (int y = 0; y < pair.left.height; ++y) {
    for (int x = 0; x < pair.left.width; ++x) {
      const int radius = brute_force_radius(pair.left, x, y, with.t2, with.t5);
      std::vector<int> costs;
      for (int d = 0; d <= std::min(x, with.levels - 1); ++d) costs.push_back(luma_cost(pair, x, y, d, radius));
      map.push_back(static_cast<int>(std::min_element(costs.begin(), costs.end()) - costs.begin()));
    }
  }
  return with.automaton ? brute_force_automaton(map, pair.left.width, pair.left.height, with.ring) : map;
}

}  // namespace epiline::test
