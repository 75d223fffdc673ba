#pragma once
// Method 2 straight from the equations: whole images, every sum computed anew, plain integers. Slow, and nothing in it
// is shared with the kernels.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "frame_harness.hpp"

namespace epiline::test {

inline int pixel_difference(const stereo_pair& pair, int x, int y, int d) {
  int sum = 0;
  for (int c = 0; c < 3; ++c) sum += std::abs(pair.left.at(x, y, c) - pair.right.at(std::max(x - d, 0), y, c));
  return sum;
}

inline int window_cost(const stereo_pair& pair, int x, int y, int d, int radius) {
  int sum = 0;
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, pair.left.height - 1); ++v) {
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, pair.left.width - 1); ++u) {
      sum += pixel_difference(pair, u, v, d);
    }
  }
  return sum;
}

/// costs[x][d] of one row, for d <= x and d < levels.
inline std::vector<std::vector<int>> row_costs(const stereo_pair& pair, int y, int levels, int radius) {
  std::vector<std::vector<int>> costs(static_cast<std::size_t>(pair.left.width));
  for (int x = 0; x < pair.left.width; ++x) {
    for (int d = 0; d <= std::min(x, levels - 1); ++d) {
      costs[static_cast<std::size_t>(x)].push_back(window_cost(pair, x, y, d, radius));
    }
  }
  return costs;
}

inline int first_of_smallest(const std::vector<int>& values) {
  return static_cast<int>(std::min_element(values.begin(), values.end()) - values.begin());
}

inline bool is_unique(const std::vector<int>& costs, int winner, int ratio) {
  for (int d = 0; d < static_cast<int>(costs.size()); ++d) {
    if (std::abs(d - winner) > 1 &&
        16 * costs[static_cast<std::size_t>(d)] < ratio * costs[static_cast<std::size_t>(winner)]) {
      return false;
    }
  }
  return true;
}

inline int right_disparity(const std::vector<std::vector<int>>& costs, int xr, int levels) {
  std::vector<int> candidates;
  for (int d = 0; d < levels && xr + d < static_cast<int>(costs.size()); ++d) {
    candidates.push_back(costs[static_cast<std::size_t>(xr + d)][static_cast<std::size_t>(d)]);
  }
  return first_of_smallest(candidates);
}

/// The tables of ALGORITHMS.md section 3.3, for 6 bits.
inline int brute_force_filter(int c, int l, int r, bool careful_fill) {
  static constexpr std::array<std::array<int, 5>, 3> degree_table{
      {{63, 31, 0, 0, 0}, {0, 32, 63, 31, 0}, {0, 0, 0, 32, 63}}};
  static constexpr const char* rules[3][3] = {{"CCC", "CCC", "CCC"}, {"CCC", "NCC", "NCC"}, {"CCC", "NCC", "NNU"}};
  const auto degrees = [](int a, int b) {
    const int delta = a == undefined || b == undefined ? 4 : std::min(std::abs(a - b), 4);
    return std::array<int, 3>{degree_table[0][static_cast<std::size_t>(delta)],
                              degree_table[1][static_cast<std::size_t>(delta)],
                              degree_table[2][static_cast<std::size_t>(delta)]};
  };
  const auto w = degrees(l, r);
  if (c == undefined) {
    const bool both = l != undefined && r != undefined;
    if (both && w[2] < 32) return std::max(l, r);
    if (careful_fill) return undefined;
    return std::min(l, r);  // undefined is the largest value
  }
  const auto u = degrees(c, l);
  const auto v = degrees(c, r);
  int centre = 0;
  int neighbours = 0;
  int nothing = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        const char set = rules[i][j][k];
        int& degree = set == 'C' ? centre : set == 'N' ? neighbours : nothing;
        degree = std::max(degree, std::min({u[i], v[j], w[k]}));
      }
    }
  }
  const int highest = std::max({centre, neighbours, nothing});
  int result = -1;
  if (centre == highest) result = std::max(result, c);
  if (neighbours == highest) {
    if (l != undefined) result = std::max(result, l);
    if (r != undefined) result = std::max(result, r);
  }
  return result < 0 ? undefined : result;
}

inline disparity_map brute_force_color_fuzzy(const stereo_pair& pair, const settings& with, int radius = 3) {
  const int width = pair.left.width;
  disparity_map map;
  for (int y = 0; y < pair.left.height; ++y) {
    const auto costs = row_costs(pair, y, with.levels, radius);
    std::vector<int> row(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
      const auto& mine = costs[static_cast<std::size_t>(x)];
      const int d = first_of_smallest(mine);
      const bool unique = with.uniqueness == 0 || is_unique(mine, d, with.uniqueness);
      const bool agrees = !with.left_right || std::abs(d - right_disparity(costs, x - d, with.levels)) <= 1;
      row[static_cast<std::size_t>(x)] = unique && agrees ? d : undefined;
    }
    for (int pass = 0; pass < with.fuzzy; ++pass) {
      const std::vector<int> before = row;
      for (int x = 0; x < width; ++x) {
        const int l = x >= 3 ? before[static_cast<std::size_t>(x - 3)] : undefined;
        const int r = x + 3 < width ? before[static_cast<std::size_t>(x + 3)] : undefined;
        row[static_cast<std::size_t>(x)] =
            brute_force_filter(before[static_cast<std::size_t>(x)], l, r, with.careful_fill);
      }
    }
    map.insert(map.end(), row.begin(), row.end());
  }
  return map;
}

}  // namespace epiline::test
