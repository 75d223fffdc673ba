#include "eval/truth_masks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace epiline::eval {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

pixel_mask empty_mask(int width, int height) {
  return {width, height, std::vector<bool>(static_cast<std::size_t>(width) * height)};
}

/// The column of the right image, perhaps outside it. Halves round to the even column, as OpenCV's rounding does.
long matching_column(int x, double disparity) { return x - std::lrint(disparity); }

/// Calls use(index of the left pixel, its disparity, index of the right pixel it matches) for every pixel of known
/// truth whose match lies in the right image.
template <class Use>
void for_each_match(const real_map& left_truth, Use use) {
  for (int y = 0; y < left_truth.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * left_truth.width;
    for (int x = 0; x < left_truth.width; ++x) {
      const double disparity = left_truth.values[row + x];
      if (!std::isfinite(disparity)) continue;
      const long column = matching_column(x, disparity);
      if (column < 0 || column >= left_truth.width) continue;
      use(row + x, disparity, row + static_cast<std::size_t>(column));
    }
  }
}

pixel_mask seen_beside(const real_map& left_truth, const real_map& right_nearest) {
  pixel_mask mask = empty_mask(left_truth.width, left_truth.height);
  for_each_match(left_truth, [&](std::size_t pixel, double disparity, std::size_t match) {
    // An unknown truth (NaN) is never "not nearer".
    mask.selected[pixel] = right_nearest.values[match] <= disparity + occlusion_threshold;
  });
  return mask;
}

}  // namespace

pixel_mask non_occluded_by_right_truth(const real_map& left_truth, const real_map& right_truth) {
  if (left_truth.width != right_truth.width || left_truth.height != right_truth.height) {
    throw std::invalid_argument("the truths of the two images differ in size");
  }
  return seen_beside(left_truth, right_truth);
}

pixel_mask non_occluded_by_left_truth(const real_map& left_truth) {
  real_map nearest{left_truth.width, left_truth.height, std::vector<double>(left_truth.values.size(), nothing)};
  for_each_match(left_truth, [&](std::size_t, double disparity, std::size_t match) {
    nearest.values[match] = std::max(nearest.values[match], disparity);
  });
  return seen_beside(left_truth, nearest);
}

pixel_mask near_discontinuities(const real_map& truth) {
  const auto at = [&](int x, int y) { return truth.values[static_cast<std::size_t>(y) * truth.width + x]; };
  const auto at_discontinuity = [&](int x, int y) {
    const double here = at(x, y);
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.height - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.width - 1); ++u) {
        if (std::abs(at(u, v) - here) > discontinuity_gap) return true;  // false with an unknown one (NaN)
      }
    }
    return false;
  };
  constexpr int reach = discontinuity_width / 2;
  pixel_mask mask = empty_mask(truth.width, truth.height);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      if (!at_discontinuity(x, y)) continue;
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, truth.height - 1); ++v) {
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, truth.width - 1); ++u) {
          mask.selected[static_cast<std::size_t>(v) * truth.width + u] = true;
        }
      }
    }
  }
  return mask;
}

pixel_mask inside_border(int width, int height, int border) {
  pixel_mask mask = empty_mask(width, height);
  for (int y = border; y < height - border; ++y) {
    for (int x = border; x < width - border; ++x) mask.selected[static_cast<std::size_t>(y) * width + x] = true;
  }
  return mask;
}

pixel_mask both(const pixel_mask& a, const pixel_mask& b) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("two masks differ in size");
  pixel_mask mask = a;
  for (std::size_t i = 0; i < mask.selected.size(); ++i) mask.selected[i] = a.selected[i] && b.selected[i];
  return mask;
}

}  // namespace epiline::eval
