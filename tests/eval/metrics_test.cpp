#include "eval/metrics.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace epiline::eval {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Eight pixels: a defined disparity or -1.
disparity_map map_of(const std::vector<int>& values, int width, int height) {
  disparity_map map(width, height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    map.defined[i] = values[i] < 0 ? 0 : 1;
    map.disparity[i] = static_cast<std::uint8_t>(values[i] < 0 ? 0 : values[i]);
  }
  return map;
}

TEST(measure, counts_exactly_by_the_definitions) {
  //                     errors:   0   0.5  0.75  1    1.25  2   2.5  (none)
  const auto map = map_of({/*   */ 5, 5, 5, 5, 5, 5, 5, -1}, 4, 2);
  const ground_truth truth{{4, 2, {5, 5.5, 4.25, 6, 3.75, 7, 2.5, 5}}, std::nullopt, std::nullopt};
  const auto figures = measure(map, &truth);
  EXPECT_EQ(figures.pixels, 8u);
  EXPECT_EQ(figures.defined, 7u);
  EXPECT_DOUBLE_EQ(figures.coverage(), 87.5);
  ASSERT_TRUE(figures.all.has_value());
  EXPECT_FALSE(figures.non_occluded.has_value());
  EXPECT_EQ(figures.all->known, 8u);
  EXPECT_EQ(figures.all->defined, 7u);
  EXPECT_EQ(figures.all->correct, 4u);   // an error of exactly 1 is correct
  EXPECT_EQ(figures.all->bad_half, 5u);  // one of exactly 0.5 is not bad
  EXPECT_EQ(figures.all->bad_one, 3u);
  EXPECT_EQ(figures.all->bad_two, 1u);
  EXPECT_DOUBLE_EQ(figures.all->average_error(), 8.0 / 7);
  EXPECT_DOUBLE_EQ(figures.all->accuracy(), 400.0 / 7);
  EXPECT_DOUBLE_EQ(figures.all->coverage(), 87.5);
  EXPECT_DOUBLE_EQ(figures.all->bad_half_share(), 500.0 / 7);
  EXPECT_DOUBLE_EQ(figures.all->bad_one_share(), 300.0 / 7);
  EXPECT_DOUBLE_EQ(figures.all->bad_two_share(), 100.0 / 7);
  EXPECT_DOUBLE_EQ(figures.all->bad_one_undefined_share(), 50);
}

TEST(measure, leaves_unknown_truth_and_masked_pixels_out) {
  const auto map = map_of({5, 5, -1, 9}, 4, 1);
  ground_truth truth{{4, 1, {5, unknown, 5, 5}}, std::nullopt, std::nullopt};
  EXPECT_EQ(measure(map, &truth).all->known, 3u);
  truth.evaluated = pixel_mask{4, 1, {true, true, true, false}};
  truth.non_occluded = pixel_mask{4, 1, {true, true, false, true}};
  const auto figures = measure(map, &truth);
  EXPECT_EQ(figures.all->known, 2u);
  EXPECT_EQ(figures.all->defined, 1u);
  EXPECT_EQ(figures.all->bad_one, 0u);
  EXPECT_DOUBLE_EQ(figures.all->bad_one_undefined_share(), 50);
  ASSERT_TRUE(figures.non_occluded.has_value());
  EXPECT_EQ(figures.non_occluded->known, 1u);  // both masks apply
  EXPECT_EQ(figures.non_occluded->correct, 1u);
  EXPECT_EQ(figures.defined, 3u);  // coverage is over the whole map
}

TEST(measure, gives_0_where_there_is_nothing_to_take_a_share_of) {
  const ground_truth truth{{2, 1, {unknown, unknown}}, std::nullopt, std::nullopt};
  const auto figures = measure(map_of({-1, 4}, 2, 1), &truth);
  EXPECT_EQ(figures.all->known, 0u);
  EXPECT_EQ(figures.all->accuracy(), 0);
  EXPECT_EQ(figures.all->coverage(), 0);
  EXPECT_EQ(figures.all->average_error(), 0);
  EXPECT_FALSE(measure(map_of({1}, 1, 1), nullptr).all.has_value());
}

TEST(measure, refuses_truth_and_masks_of_another_size) {
  const auto map = map_of({1, 1}, 2, 1);
  const real_map fitting{2, 1, {1, 1}};
  const pixel_mask turned{1, 2, {true, true}};
  const ground_truth wrong_truth{{1, 2, {1, 1}}, std::nullopt, std::nullopt};
  const ground_truth wrong_mask{fitting, turned, std::nullopt};
  const ground_truth wrong_non_occluded{fitting, std::nullopt, turned};
  for (const auto* truth : {&wrong_truth, &wrong_mask, &wrong_non_occluded}) {
    EXPECT_THROW((void)measure(map, truth), std::invalid_argument);
  }
}

TEST(compare, counts_differences_of_disparity_and_of_valid_bit) {
  const auto a = map_of({1, 0, -1, 4, 5, 6}, 3, 2);
  EXPECT_EQ(compare(a, a).differing, 0u);
  EXPECT_EQ(compare(a, a).pixels, 6u);
  const auto difference = compare(a, map_of({1, -1, -1, 4, 5, 7}, 3, 2));
  EXPECT_EQ(difference.differing, 2u);
  EXPECT_EQ(difference.first_x, 1);
  EXPECT_EQ(difference.first_y, 0);
  EXPECT_EQ(compare(a, map_of({1, 0, -1, 4, 5, -1}, 3, 2)).first_y, 1);
  EXPECT_THROW((void)compare(a, map_of({1}, 1, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace epiline::eval
