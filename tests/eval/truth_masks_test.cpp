#include "eval/truth_masks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace epiline::eval {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string text_of(const pixel_mask& mask) {
  std::string text;
  for (const bool selected : mask.selected) text += selected ? '#' : '.';
  return text;
}

TEST(non_occluded, by_right_truth_needs_a_match_in_the_image_that_is_known_and_not_nearer) {
  //                        column: 0  1  2  3        4  5    6  7
  const real_map left{8, 1, {/*  */ 1, 1, 2, unknown, 2, 2.5, 4, 2}};
  //                  lands on:    -1  0  0           2  3    2  5       (5 - 2.5 = 3 - 2 or 3: halves to even, 2)
  const real_map right{8, 1, {/* */ 1, 9, 2, 2, 9, unknown, 9, 9}};
  // Column 1 lands on 0, where the right truth is 1. Column 2 lands on 0 and is nearer than what is there, which hides
  // nothing. 4 lands on 2, equal. 5 lands on 3. 6 lands on 2. 7 lands on 5, which is unknown. 0 lands outside.
  EXPECT_EQ(text_of(non_occluded_by_right_truth(left, right)), ".##.###.");
  EXPECT_EQ(text_of(non_occluded_by_right_truth({3, 1, {0, 0, 0}}, {3, 1, {0, 1, 1.01}})), "##.");
  EXPECT_THROW((void)non_occluded_by_right_truth(left, {4, 2, right.values}), std::invalid_argument);
}

TEST(non_occluded, by_left_truth_is_what_nothing_nearer_lands_on) {
  //                     column: 0  1  2  3  4  5
  const real_map left{6, 1, {/**/ 0, 0, 0, 0, 3, 0}};  // column 4 lands on 1
  EXPECT_EQ(text_of(non_occluded_by_left_truth(left)), "#.####");
  // An occluder of unknown truth is not seen, and an unknown pixel is never selected.
  EXPECT_EQ(text_of(non_occluded_by_left_truth({6, 1, {0, 0, 0, 0, unknown, 0}})), "####.#");
  EXPECT_EQ(text_of(non_occluded_by_left_truth({3, 1, {1, 0, 3}})), ".#.");  // outside to the left
  EXPECT_EQ(text_of(non_occluded_by_left_truth({3, 1, {0, 0, 1}})), "###");  // nearer by 1 is within the threshold
}

TEST(non_occluded, by_either_truth_agree_where_both_are_exact) {
  // A plane with a nearer bar: the right truth is rendered with the bar in front.
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const int width = 20 + static_cast<int>(random() % 20);
    const int far = static_cast<int>(random() % 3);
    const int near = far + 2 + static_cast<int>(random() % 4);
    const int begin = near + static_cast<int>(random() % 6);
    const int end = begin + 2 + static_cast<int>(random() % 6);
    real_map left{width, 1, std::vector<double>(static_cast<std::size_t>(width), far)};
    real_map right = left;
    for (int x = begin; x < end; ++x) {
      left.values[static_cast<std::size_t>(x)] = near;
      right.values[static_cast<std::size_t>(x - near)] = near;
    }
    EXPECT_EQ(text_of(non_occluded_by_right_truth(left, right)), text_of(non_occluded_by_left_truth(left)));
  }
}

TEST(near_discontinuities, are_a_square_around_each_jump_of_more_than_the_gap) {
  real_map truth{30, 12, std::vector<double>(360, 5)};
  EXPECT_EQ(text_of(near_discontinuities(truth)), std::string(360, '.'));
  truth.values[5 * 30 + 20] = 7;  // 2 is not more than 2
  EXPECT_EQ(text_of(near_discontinuities(truth)), std::string(360, '.'));
  truth.values[5 * 30 + 20] = 7.01;
  // The pixel and its eight neighbours are at a discontinuity; each makes a square of 9.
  const auto mask = near_discontinuities(truth);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 30; ++x) {
      const bool near = std::abs(x - 20) <= 5 && std::abs(y - 5) <= 5;
      EXPECT_EQ(mask.selected[static_cast<std::size_t>(y) * 30 + x], near) << x << ' ' << y;
    }
  }
}

TEST(near_discontinuities, are_not_made_by_unknown_truth) {
  real_map truth{12, 3, std::vector<double>(36, 5)};
  truth.values[17] = unknown;
  EXPECT_EQ(text_of(near_discontinuities(truth)), std::string(36, '.'));
  EXPECT_EQ(text_of(near_discontinuities({1, 1, {3}})), ".");
}

TEST(inside_border, leaves_a_frame_out) {
  EXPECT_EQ(text_of(inside_border(5, 3, 1)), "......###......");
  EXPECT_EQ(text_of(inside_border(2, 2, 0)), "####");
  EXPECT_EQ(text_of(inside_border(4, 2, 1)), "........");
  EXPECT_EQ(text_of(inside_border(2, 2, 9)), "....");
}

TEST(both, is_the_intersection_and_needs_one_size) {
  EXPECT_EQ(text_of(both({4, 1, {true, true, false, false}}, {4, 1, {true, false, true, false}})), "#...");
  EXPECT_THROW((void)both({4, 1, {true, true, true, true}}, {2, 2, {true, true, true, true}}), std::invalid_argument);
}

}  // namespace
}  // namespace epiline::eval
