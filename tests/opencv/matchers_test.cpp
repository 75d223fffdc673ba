// Our measures against numbers that others published: OpenCV's matchers on the classical pairs under the definitions of
// OpenCV's own regression test (error above 1 pixel, a border of 10 pixels left out, undefined pixels wrong, occlusion
// and discontinuities computed from the truth), beside the results that OpenCV stores for that test in opencv_extra,
// testdata/cv/stereomatching/algorithms/stereobm_res.xml and stereosgbm_res.xml.

#include "opencv/matchers.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "eval/random_images.hpp"
#include "eval/real_pairs.hpp"
#include "eval/truth_masks.hpp"

namespace epiline::opencv {
namespace {

enum mode { sgbm = 0, hh = 1, three_way = 2, hh4 = 3 };

/// Results come from the matcher and from the measure. Where OpenCV 4.6, which Debian 12 has, still computes what the
/// version computed that made the stored result, all digits must agree. Elsewhere OpenCV's own test allows 2.2 (block
/// matching) and 1 (semi-global) percentage points; we measured what the differences are and allow no more:
/// - StereoBM and StereoSGBM's first two modes evidently changed since their results were stored (2013).
/// - Teddy and Cones differ in every mode, also in the one that agrees to all digits on Tsukuba and Venus, so probably
///   the pictures: OpenCV's copies of these two were not at hand.
constexpr double all_digits = 0.00005;
constexpr double older_block_matching = 0.11;
constexpr double older_semi_global = 0.3;
constexpr double other_pictures = 0.6;

struct published_case {
  const char* scene;
  regression_case settings;
  double all;           // borderedAllBadPxlsFraction, in per cent
  double non_occluded;  // borderedNoOcclBadPxlsFraction, in per cent
  double tolerance;     // percentage points
};

constexpr auto block = matcher::block_matching;
constexpr auto semi_global = matcher::semi_global;
constexpr published_case published[] = {
    {"tsukuba", {block, 16, 21, 0}, 14.0679, 12.6371, older_block_matching},
    {"venus", {block, 32, 43, 0}, 15.7258, 14.7991, older_block_matching},
    {"teddy", {block, 48, 15, 0}, 27.1927, 20.1918, older_block_matching},
    {"cones", {block, 64, 11, 0}, 25.3189, 17.2936, older_block_matching},
    {"tsukuba", {semi_global, 16, 1, sgbm}, 6.5704, 4.4410, older_semi_global},
    {"venus", {semi_global, 32, 3, sgbm}, 16.2109, 14.7115, older_semi_global},
    {"teddy", {semi_global, 48, 3, sgbm}, 22.2888, 14.8758, other_pictures},
    {"cones", {semi_global, 64, 5, sgbm}, 22.5310, 14.1485, other_pictures},
    {"teddy", {semi_global, 48, 3, hh}, 22.4469, 15.0428, other_pictures},
    {"cones", {semi_global, 64, 5, hh}, 22.7088, 14.3274, other_pictures},
    // The newest results of this mode. The first ones (venus 13.91 / 12.37, teddy 18.61 / 10.95, cones 15.53 / 6.61)
    // belong to an earlier form of the mode, 3.6 to 7 points better on these three than the version that Debian has.
    {"tsukuba", {semi_global, 16, 1, three_way}, 6.1257, 4.0255, older_semi_global},
    {"venus", {semi_global, 32, 3, three_way}, 17.5417, 16.0674, older_semi_global},
    {"teddy", {semi_global, 48, 3, three_way}, 22.0737, 14.6499, other_pictures},
    {"cones", {semi_global, 64, 5, three_way}, 22.4479, 14.0560, other_pictures},
    {"tsukuba", {semi_global, 16, 1, hh4}, 5.7061, 3.5971, all_digits},
    {"venus", {semi_global, 32, 3, hh4}, 16.4165, 14.9175, all_digits},
    {"teddy", {semi_global, 48, 3, hh4}, 22.3303, 14.9266, other_pictures},
    {"cones", {semi_global, 64, 5, hh4}, 22.6311, 14.2402, other_pictures},
};

eval::map_figures figures_of(const published_case& published_as, const test::real_pair& pair) {
  const auto& settings = published_as.settings;
  const auto map = match_as_in_regression_test(settings, pair.left, pair.right);
  eval::ground_truth truth{pair.truth.disparity, std::nullopt, std::nullopt, std::nullopt};
  const int unmatched = settings.kind == matcher::block_matching ? settings.window / 2 : 0;
  truth.evaluated = eval::inside_border(map.width, map.height, std::max(10, unmatched));
  truth.non_occluded = pair.right_truth ? eval::non_occluded_by_right_truth(truth.disparity, *pair.right_truth)
                                        : eval::non_occluded_by_left_truth(truth.disparity);
  truth.near_discontinuity = eval::both(*truth.non_occluded, eval::near_discontinuities(truth.disparity));
  return eval::measure(map, &truth);
}

class opencv_regression : public testing::TestWithParam<published_case> {};

TEST_P(opencv_regression, our_measures_give_the_published_shares_of_bad_pixels) {
  const auto& expected = GetParam();
  const auto pair = test::find_real_pair(expected.scene);
  if (!pair) GTEST_SKIP() << expected.scene << " is not on this machine (EPILINE_DATA)";
  const auto figures = figures_of(expected, *pair);
  EXPECT_NEAR(figures.all->bad_one_undefined_share(), expected.all, expected.tolerance);
  EXPECT_NEAR(figures.non_occluded->bad_one_undefined_share(), expected.non_occluded, expected.tolerance);
}

INSTANTIATE_TEST_SUITE_P(published, opencv_regression, testing::ValuesIn(published), [](const auto& test) {
  const auto& settings = test.param.settings;
  return settings.kind == block ? fmt::format("{}_block_matching", test.param.scene)
                                : fmt::format("{}_semi_global_mode_{}", test.param.scene, settings.mode);
});

TEST(opencv_regression, the_measure_near_discontinuities_agrees_to_all_digits_too) {
  const std::pair<published_case, double> expected[] = {{published[14], 15.0304}, {published[15], 23.2401}};
  for (const auto& [settings, share] : expected) {
    const auto pair = test::find_real_pair(settings.scene);
    if (!pair) GTEST_SKIP() << settings.scene << " is not on this machine (EPILINE_DATA)";
    const auto figures = figures_of(settings, *pair);
    EXPECT_NEAR(figures.near_discontinuity->bad_one_undefined_share(), share, all_digits) << settings.scene;
  }
}

TEST(opencv_match, finds_a_shifted_plane_up_to_the_left_edge_and_marks_what_it_does_not_know) {
  // A random texture 5 pixels nearer than infinity: the left 5 columns are not in the right image.
  std::mt19937 random(7);
  constexpr int width = 120;
  constexpr int height = 60;
  constexpr int shift = 5;
  eval::rgb_image left(width, height);
  eval::rgb_image right(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width + shift; ++x) {
      const auto grey = static_cast<std::uint8_t>(random() % 256);
      for (int c = 0; c < 3; ++c) {
        if (x < width) left.at(x, y)[c] = grey;
        if (x >= shift) right.at(x - shift, y)[c] = grey;
      }
    }
  }
  for (const auto kind : {matcher::block_matching, matcher::semi_global}) {
    const auto map = match(kind, left, right, 20);
    ASSERT_EQ(map.width, width);
    ASSERT_EQ(map.values.size(), std::size_t{width} * height);
    for (int y = 15; y < height - 15; ++y) {
      for (const int x : {15, 25, 60, width - 20}) {  // also where OpenCV alone has no 32 candidates
        EXPECT_NEAR(map.values[static_cast<std::size_t>(y) * width + x], shift, 0.5) << x << ' ' << y;
      }
    }
    EXPECT_TRUE(std::ranges::any_of(map.values, [](double value) { return std::isnan(value); }));
    EXPECT_TRUE(std::ranges::none_of(map.values, [](double value) { return value < 0; }));
  }
}

TEST(opencv_match, searches_the_next_multiple_of_16_levels) {
  EXPECT_EQ(levels_searched(1), 16);
  EXPECT_EQ(levels_searched(16), 16);
  EXPECT_EQ(levels_searched(17), 32);
  EXPECT_EQ(levels_searched(80), 80);
}

TEST(opencv_match, refuses_images_of_different_sizes_and_no_levels) {
  for (const auto kind : {matcher::block_matching, matcher::semi_global}) {
    EXPECT_THROW((void)match(kind, {40, 30}, {41, 30}, 16), std::invalid_argument);
    EXPECT_THROW((void)match(kind, {40, 30}, {40, 30}, 0), std::invalid_argument);
  }
  EXPECT_THROW((void)match_as_in_regression_test({block, 16, 9, 0}, {40, 30}, {40, 31}), std::invalid_argument);
}

}  // namespace
}  // namespace epiline::opencv
