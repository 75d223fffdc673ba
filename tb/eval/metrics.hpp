#pragma once
// How good a disparity map is, in exact counts (ALGORITHMS.md section 0).

#include <cstdint>
#include <optional>

#include "eval/frame.hpp"
#include "eval/image_files.hpp"

namespace epiline::eval {

/// Counts over one set of pixels whose truth is known.
struct accuracy_counts {
  std::uint64_t known = 0;     // pixels of the set
  std::uint64_t defined = 0;   // of these, with a disparity
  std::uint64_t correct = 0;   // defined and |d - truth| <= 1
  std::uint64_t bad_half = 0;  // defined and |d - truth| > 0.5
  std::uint64_t bad_one = 0;   // > 1
  std::uint64_t bad_two = 0;   // > 2
  double error_sum = 0;        // of |d - truth| over the defined pixels

  /// Shares in per cent; 0 when there is nothing to take a share of.
  [[nodiscard]] double coverage() const;                 // defined / known
  [[nodiscard]] double accuracy() const;                 // correct / defined
  [[nodiscard]] double bad_half_share() const;           // bad_half / defined
  [[nodiscard]] double bad_one_share() const;            // bad_one / defined
  [[nodiscard]] double bad_two_share() const;            // bad_two / defined
  [[nodiscard]] double bad_one_undefined_share() const;  // (bad_one + undefined) / known
  [[nodiscard]] double average_error() const;            // in pixels
};

struct map_figures {
  std::uint64_t pixels = 0;                           // of the whole map
  std::uint64_t defined = 0;                          // of the whole map
  std::optional<accuracy_counts> all;                 // with truth
  std::optional<accuracy_counts> non_occluded;        // with truth and a mask of non-occluded pixels
  std::optional<accuracy_counts> near_discontinuity;  // with truth and a mask of pixels near depth discontinuities

  /// defined / pixels in per cent.
  [[nodiscard]] double coverage() const;
};

/// What the map is compared with; the masks restrict the pixels that count.
struct ground_truth {
  real_map disparity;
  std::optional<pixel_mask> evaluated;
  std::optional<pixel_mask> non_occluded;          // applied on top of `evaluated`
  std::optional<pixel_mask> near_discontinuity{};  // applied on top of `evaluated`
};

/// Compares a map of real disparities (NaN = undefined) with the truth; without one only coverage is known.
/// Throws std::invalid_argument when the truth or a mask has another size than the map.
[[nodiscard]] map_figures measure(const real_map& map, const ground_truth* truth);
[[nodiscard]] map_figures measure(const disparity_map& map, const ground_truth* truth);

/// How two maps differ: bit for bit, valid bit included.
struct map_difference {
  std::uint64_t pixels = 0;
  std::uint64_t differing = 0;
  int first_x = 0;  // the first difference in raster order; of use only if differing > 0
  int first_y = 0;
};

/// Throws std::invalid_argument when the sizes differ.
[[nodiscard]] map_difference compare(const disparity_map& a, const disparity_map& b);

}  // namespace epiline::eval
