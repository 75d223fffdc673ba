#include "eval/metrics.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
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

TEST(measure, counts_subpixel_disparities_and_pixels_near_discontinuities) {
  const real_map map{5, 1, {3.0625, 3.5, 4.0625, unknown, 6}};
  ground_truth truth{{5, 1, {3, 3, 3, 3, 3}}, std::nullopt, std::nullopt};
  truth.evaluated = pixel_mask{5, 1, {true, true, true, true, false}};
  truth.near_discontinuity = pixel_mask{5, 1, {false, false, true, true, true}};
  const auto figures = measure(map, &truth);
  EXPECT_EQ(figures.defined, 4u);
  EXPECT_EQ(figures.all->known, 4u);
  EXPECT_EQ(figures.all->defined, 3u);
  EXPECT_EQ(figures.all->correct, 2u);
  EXPECT_EQ(figures.all->bad_half, 1u);
  EXPECT_DOUBLE_EQ(figures.all->average_error(), (0.0625 + 0.5 + 1.0625) / 3);
  EXPECT_FALSE(figures.non_occluded.has_value());
  ASSERT_TRUE(figures.near_discontinuity.has_value());
  EXPECT_EQ(figures.near_discontinuity->known, 2u);  // the mask of evaluated pixels applies, too
  EXPECT_EQ(figures.near_discontinuity->defined, 1u);
  EXPECT_EQ(figures.near_discontinuity->correct, 0u);
  EXPECT_DOUBLE_EQ(figures.near_discontinuity->bad_one_undefined_share(), 100);
}

/// What must hold of any map and truth.
TEST(measure, obeys_its_own_arithmetic_on_random_maps) {
  std::mt19937 random(17);
  for (int trial = 0; trial < 200; ++trial) {
    const int width = 1 + static_cast<int>(random() % 9);
    const int height = 1 + static_cast<int>(random() % 9);
    disparity_map map(width, height);
    ground_truth truth{{width, height, {}}, std::nullopt, std::nullopt};
    pixel_mask part{width, height, {}};
    for (std::size_t i = 0; i < map.defined.size(); ++i) {
      map.defined[i] = random() % 4 != 0 ? 1 : 0;
      map.disparity[i] = map.defined[i] != 0 ? static_cast<std::uint8_t>(random() % 8) : 0;
      truth.disparity.values.push_back(random() % 5 == 0 ? unknown : static_cast<double>(random() % 32) / 4);
      part.selected.push_back(random() % 2 == 0);
    }
    const auto whole = measure(map, &truth);
    const auto& all = *whole.all;
    EXPECT_LE(all.bad_two, all.bad_one);
    EXPECT_LE(all.bad_one, all.bad_half);
    EXPECT_EQ(all.correct + all.bad_one, all.defined);
    EXPECT_LE(all.defined, all.known);
    EXPECT_LE(all.defined, whole.defined);
    if (all.defined != 0) {
      EXPECT_NEAR(all.accuracy() + all.bad_one_share(), 100, 1e-9);
    }
    if (all.known != 0) {
      EXPECT_NEAR(all.bad_one_undefined_share(), 100 - all.accuracy() * all.coverage() / 100, 1e-9);
    }

    // A region and what is outside it make up the whole.
    pixel_mask rest = part;
    rest.selected.flip();
    truth.non_occluded = part;
    truth.near_discontinuity = rest;
    const auto parts = measure(map, &truth);
    EXPECT_EQ(parts.non_occluded->known + parts.near_discontinuity->known, all.known);
    EXPECT_EQ(parts.non_occluded->correct + parts.near_discontinuity->correct, all.correct);
    EXPECT_DOUBLE_EQ(parts.non_occluded->error_sum + parts.near_discontinuity->error_sum, all.error_sum);
    // As if only that region were evaluated.
    truth.evaluated = part;
    truth.non_occluded.reset();
    truth.near_discontinuity.reset();
    EXPECT_EQ(measure(map, &truth).all->bad_half, parts.non_occluded->bad_half);

    // Disparities count relative to the truth only.
    truth.evaluated.reset();
    real_map shifted = real_values_of(map);
    for (double& value : shifted.values) value += 2.25;
    for (double& value : truth.disparity.values) value += 2.25;
    EXPECT_EQ(measure(shifted, &truth).all->correct, all.correct);
    EXPECT_EQ(measure(shifted, &truth).all->bad_half, all.bad_half);
    EXPECT_EQ(measure(shifted, &truth).defined, whole.defined);
  }
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
  const ground_truth wrong_discontinuity{fitting, std::nullopt, std::nullopt, turned};
  for (const auto* truth : {&wrong_truth, &wrong_mask, &wrong_non_occluded, &wrong_discontinuity}) {
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
