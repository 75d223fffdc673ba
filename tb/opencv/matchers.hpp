#pragma once
// OpenCV's two stereo matchers, as references on the same pairs and under the same measures.

#include <string>

#include "eval/frame.hpp"
#include "eval/image_files.hpp"

namespace epiline::opencv {

/// OpenCV's matchers search a multiple of 16 levels.
[[nodiscard]] int levels_searched(int levels);

enum class matcher { block_matching, semi_global };

/// The parameters of match() in OpenCV's own words, for tables.
[[nodiscard]] std::string parameters_of(matcher kind);

/// Subpixel disparities, NaN = undefined. The pictures are extended to the left by as many columns as levels are
/// searched, since OpenCV computes nothing for pixels that have not all candidates: so every pixel has its chance, as
/// in Epiline's designs. Throws std::invalid_argument when the images differ in size or levels < 1.
[[nodiscard]] eval::real_map match(matcher kind, const eval::rgb_image& left, const eval::rgb_image& right, int levels);

/// One case of OpenCV's own regression test (modules/calib3d/test/test_stereomatching.cpp): its matcher with that
/// window and the test's other parameters on the pictures as they are, disparities as the test takes them (those of
/// StereoSGBM in whole pixels), undefined ones with the number that OpenCV gives them (-1), so that they count as
/// wrong. `mode` is StereoSGBM's and without meaning for block matching.
struct regression_case {
  matcher kind;
  int levels;
  int window;
  int mode;
};
[[nodiscard]] eval::real_map match_as_in_regression_test(const regression_case& settings, const eval::rgb_image& left,
                                                         const eval::rgb_image& right);

}  // namespace epiline::opencv
