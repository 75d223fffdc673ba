#pragma once
// Sets of pixels that follow from the ground truth, for pairs that come without masks. The definitions are those of
// D. Scharstein and R. Szeliski, A taxonomy and evaluation of dense two-frame stereo correspondence algorithms
// (IJCV 47, 2002), with their constants, as OpenCV's test of its matchers has them.

#include "eval/image_files.hpp"

namespace epiline::eval {

/// A pixel is occluded when what it matches in the right image is nearer by more than this, in pixels of disparity.
inline constexpr double occlusion_threshold = 1;
/// A pixel and one of its eight neighbours are at a discontinuity when their disparities differ by more than this.
inline constexpr double discontinuity_gap = 2;
/// Pixels in a square of this width around one at a discontinuity are near it.
inline constexpr int discontinuity_width = 9;

/// Pixels of known truth d that the right camera sees too: column x - d, rounded, lies in the image, and the right
/// image's truth there is known and not nearer by more than `occlusion_threshold`.
/// Throws std::invalid_argument when the sizes differ.
[[nodiscard]] pixel_mask non_occluded_by_right_truth(const real_map& left_truth, const real_map& right_truth);

/// The same from the left truth alone: what hides a pixel is another one that lands on the same column of the right
/// image. Sees no occluder whose own truth is unknown.
[[nodiscard]] pixel_mask non_occluded_by_left_truth(const real_map& left_truth);

/// Pixels within `discontinuity_width` of one whose known truth differs from a known neighbour's (of eight) by more
/// than `discontinuity_gap`.
[[nodiscard]] pixel_mask near_discontinuities(const real_map& truth);

/// Pixels at least `border` away from every edge.
[[nodiscard]] pixel_mask inside_border(int width, int height, int border);

/// Pixels of both. Throws std::invalid_argument when the sizes differ.
[[nodiscard]] pixel_mask both(const pixel_mask& a, const pixel_mask& b);

}  // namespace epiline::eval
