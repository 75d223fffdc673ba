#include "golden/adaptive_ca.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "golden/streaming_automaton.hpp"

namespace epiline::golden {
namespace {

using grey = plane<std::uint8_t>;

colour_image colour_of(const grey& image) { return {image, image, image}; }

grey random_grey(std::mt19937& random, int rows, int columns, int values) {
  const int step = 255 / (values - 1);
  return grey(rows, columns).unaryExpr([&](std::uint8_t) {
    return static_cast<std::uint8_t>(step * static_cast<int>(random() % static_cast<unsigned>(values)));
  });
}

bool equal(const disparity_plane& a, const disparity_plane& b) {
  return (a.disparity == b.disparity).all() && (a.defined == b.defined).all();
}

// ---- matching

TEST(luma, weighs_green_twice_and_rounds_half_up) {
  const auto of = [](int red, int green, int blue) {
    const auto colour = [](int value) { return grey::Constant(1, 1, static_cast<std::uint8_t>(value)); };
    return static_cast<int>(luma({colour(red), colour(green), colour(blue)})(0, 0));
  };
  EXPECT_EQ(of(0, 0, 0), 0);
  EXPECT_EQ(of(255, 255, 255), 255);
  EXPECT_EQ(of(200, 0, 0), 50);
  EXPECT_EQ(of(0, 100, 0), 50);
  EXPECT_EQ(of(0, 0, 200), 50);
  EXPECT_EQ(of(1, 0, 0), 0);  // 3 / 4
  EXPECT_EQ(of(1, 0, 1), 1);  // 4 / 4
}

TEST(local_variation, is_zero_on_a_flat_image_and_reaches_its_largest_value) {
  EXPECT_TRUE((local_variation_2x2(grey::Constant(6, 7, 90)) == 0).all());
  EXPECT_TRUE((local_variation_5x5(grey::Constant(6, 7, 90)) == 0).all());
  grey halves = grey::Zero(9, 9);
  halves.rightCols(4) = 255;  // columns 5 ..
  EXPECT_EQ(local_variation_2x2(halves)(4, 4), 2040);
  EXPECT_EQ(local_variation_2x2(halves)(4, 5), 0);
  EXPECT_EQ(local_variation_5x5(halves)(4, 4), 2 * 10 * 15 * 255);
  halves(2, 4) = halves(3, 4) = halves(4, 4) = 255;  // 13 white pixels of 25: as near to half as can be
  EXPECT_EQ(local_variation_5x5(halves)(4, 4), 79560);
}

TEST(local_variation, belongs_to_the_upper_left_pixel_of_2x2_and_the_centre_of_5x5) {
  grey dot = grey::Zero(9, 9);
  dot(4, 4) = 100;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool in_2x2 = (y == 3 || y == 4) && (x == 3 || x == 4);
      EXPECT_EQ(local_variation_2x2(dot)(y, x), in_2x2 ? 600 : 0) << y << "," << x;
      const bool in_5x5 = std::abs(y - 4) <= 2 && std::abs(x - 4) <= 2;
      EXPECT_EQ(local_variation_5x5(dot)(y, x), in_5x5 ? 2 * 24 * 100 : 0) << y << "," << x;
    }
  }
}

int naive_variation(const grey& image, int y, int x, int before, int after) {
  std::vector<int> values;
  int sum = 0;
  for (int j = y - before; j <= y + after; ++j) {
    for (int i = x - before; i <= x + after; ++i) {
      values.push_back(
          image(std::clamp<Eigen::Index>(j, 0, image.rows() - 1), std::clamp<Eigen::Index>(i, 0, image.cols() - 1)));
      sum += values.back();
    }
  }
  int variation = 0;
  for (const int value : values) variation += std::abs(static_cast<int>(values.size()) * value - sum);
  return variation;
}

int naive_window(const grey& left, int y, int x, int t2, int t5) {
  if (naive_variation(left, y, x, 0, 1) > 4 * t2) return 3;
  return naive_variation(left, y, x, 2, 2) > 25 * t5 ? 5 : 7;
}

int naive_cost(const grey& left, const grey& right, int y, int x, int d, int window) {
  int sum = 0;
  for (int j = y - window / 2; j <= y + window / 2; ++j) {
    for (int i = x - window / 2; i <= x + window / 2; ++i) {
      if (j < 0 || j >= left.rows() || i < 0 || i >= left.cols()) continue;
      sum += std::abs(left(j, i) - right(j, std::max(i - d, 0)));
    }
  }
  return sum;
}

TEST(chosen_window, is_decided_above_and_not_at_the_thresholds) {
  grey dot = grey::Zero(9, 9);
  dot(4, 4) = 100;  // variations 600 and 4800
  EXPECT_EQ(chosen_window(dot, 149, 100)(4, 4), 3);
  EXPECT_EQ(chosen_window(dot, 150, 100)(4, 4), 5);
  EXPECT_EQ(chosen_window(dot, 150, 191)(4, 4), 5);
  EXPECT_EQ(chosen_window(dot, 150, 192)(4, 4), 7);
  EXPECT_EQ(chosen_window(dot, 0, 0)(0, 0), 7);  // flat is flat whatever the thresholds
}

TEST(adaptive_cost, reaches_the_largest_sum_of_each_window) {
  const grey white = grey::Constant(9, 9, 255);
  const grey black = grey::Zero(9, 9);
  for (const int side : {3, 5, 7}) {
    const grey window = grey::Constant(9, 9, static_cast<std::uint8_t>(side));
    EXPECT_EQ(adaptive_cost(white, black, window, 0)(4, 4), side * side * 255);
    EXPECT_EQ(adaptive_cost(white, black, window, 0)(0, 8), (side / 2 + 1) * (side / 2 + 1) * 255);
  }
}

TEST(adaptive_winners, agree_with_the_definitions_pixel_by_pixel) {
  std::mt19937 random(21);
  std::map<int, int> windows;
  int ties = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int rows = 1 + static_cast<int>(random() % 10);
    const int columns = 1 + static_cast<int>(random() % 24);
    const int values = repeat % 3 == 0 ? 2 : 256;  // two values: many ties
    const grey left = random_grey(random, rows, columns, values);
    const grey right = random_grey(random, rows, columns, values);
    const adaptive_ca_parameters with{.levels = 1 + static_cast<int>(random() % 30),
                                      .t2 = 40 + static_cast<int>(random() % 216),
                                      .t5 = 1000 + static_cast<int>(random() % 1000)};
    const auto map = adaptive_winners(colour_of(left), colour_of(right), with);
    ASSERT_TRUE(map.defined.all());
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const int window = naive_window(left, y, x, with.t2, with.t5);
        ++windows[window];
        int winner = 0;
        for (int d = 1; d < with.levels && d <= x; ++d) {
          const int cost = naive_cost(left, right, y, x, d, window);
          const int best = naive_cost(left, right, y, x, winner, window);
          ties += cost == best;
          if (cost < best) winner = d;
        }
        ASSERT_EQ(map.disparity(y, x), winner) << rows << "x" << columns << " at " << y << "," << x;
      }
    }
  }
  EXPECT_GT(windows[3], 200);
  EXPECT_GT(windows[5], 200);
  EXPECT_GT(windows[7], 200);
  EXPECT_GT(ties, 200);
}

// ---- the automaton

constexpr int none = -1;

disparity_plane map_of(const std::vector<std::vector<int>>& rows) {
  plane<int> labels(rows.size(), rows[0].size());
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t x = 0; x < rows[y].size(); ++x) labels(y, x) = rows[y][x];
  }
  return {labels.max(0).cast<std::uint8_t>(), labels >= 0};
}

TEST(automaton_rule_1, clears_the_lonely_and_bears_where_seven_agree) {
  EXPECT_TRUE(equal(automaton_rule_1(map_of({{1, 2, 1}, {3, 4, 3}, {1, 2, 1}}), 8),
                    map_of({{none, none, none}, {none, none, none}, {none, none, none}})));
  // Eight: born. The corners have company and stay.
  EXPECT_TRUE(
      equal(automaton_rule_1(map_of({{5, 5, 5}, {5, 2, 5}, {5, 5, 5}}), 8), map_of({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}})));
  // Seven: born, although the eighth keeps company with the old level, which the pixel leaves.
  EXPECT_TRUE(
      equal(automaton_rule_1(map_of({{2, 5, 5}, {5, 2, 5}, {5, 5, 5}}), 8), map_of({{2, 5, 5}, {5, 5, 5}, {5, 5, 5}})));
  // Six: not born.
  EXPECT_TRUE(
      equal(automaton_rule_1(map_of({{2, 2, 5}, {5, 2, 5}, {5, 5, 5}}), 8), map_of({{2, 2, 5}, {5, 2, 5}, {5, 5, 5}})));
  // Undefined pixels are born as well, and are no neighbours.
  EXPECT_TRUE(equal(automaton_rule_1(map_of({{none, 5, 5}, {5, none, 5}, {5, 5, 5}}), 8),
                    map_of({{none, 5, 5}, {5, 5, 5}, {5, 5, 5}})));
}

TEST(automaton_rule_2, counts_the_ring_of_forty_cells) {
  // Level 3 in the middle, 2 to the sides of it: 20 ring cells left of the middle column's neighbours and 14 + 6
  // others.
  disparity_plane map{grey::Constant(7, 7, 3), plane<bool>::Constant(7, 7, true)};
  // 7x7 pixels: the ring of the middle one is the frame's margin.
  for (const int ring : {1, 24, 40}) EXPECT_TRUE(automaton_rule_2(map, 8, ring).defined(3, 3)) << ring;
  EXPECT_EQ(automaton_rule_2(map, 8, 40).defined.count(), 1);  // elsewhere the border cuts the ring off
  map.disparity(0, 6) = 2;                                     // 39 cells
  EXPECT_FALSE(automaton_rule_2(map, 8, 40).defined(3, 3));
  EXPECT_TRUE(automaton_rule_2(map, 8, 39).defined(3, 3));
  map.defined(6, 0) = false;  // 38
  map.disparity(6, 0) = 0;
  EXPECT_FALSE(automaton_rule_2(map, 8, 39).defined(3, 3));
  EXPECT_EQ(automaton_rule_2(map, 8, 38).disparity(3, 3), 3);
  // The 3x3 itself does not count.
  map.disparity(3, 2) = 2;
  EXPECT_EQ(automaton_rule_2(map, 8, 38).disparity(3, 3), 3);
  // A level of which the ring is full but that is not in the 3x3 does not claim.
  map.disparity.block(2, 2, 3, 3) = 2;
  EXPECT_FALSE(automaton_rule_2(map, 8, 2).defined(3, 3));
}

TEST(automaton_rule_2, leaves_a_pixel_undefined_that_two_levels_claim) {
  disparity_plane map{grey::Constant(7, 8, 3), plane<bool>::Constant(7, 8, true)};
  map.disparity.rightCols(4) = 6;
  const auto claimed = automaton_rule_2(map, 8, 12);
  EXPECT_TRUE((claimed.defined.row(3).head(3)).all());
  EXPECT_TRUE((claimed.disparity.row(3).head(3) == std::uint8_t{3}).all());
  EXPECT_FALSE(claimed.defined(3, 3));  // columns 0..3 and 4..6: 25 and 15 ring cells
  EXPECT_TRUE(automaton_rule_2(map, 8, 19).defined(3, 3));
}

/// Labels of which every branch of the automaton has something to do: patches, thin structures and noise, some of them
/// undefined.
disparity_plane random_labels(std::mt19937& random, int levels) {
  const auto below = [&](int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); };
  const int rows = 1 + below(24);
  const int columns = 1 + below(40);
  const int first = below(levels);
  const int used = 1 + below(4);
  const int noise = 1 << below(6);  // one pixel in so many
  const int split_row = below(rows);
  const int split_column = below(columns);
  disparity_plane map{grey::Zero(rows, columns), plane<bool>::Constant(rows, columns, true)};
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      int label = (y < split_row ? 0 : 1) + (x < split_column ? 0 : 2);
      if (below(noise) == 0) label = below(used + 1);
      map.defined(y, x) = label < used;
      map.disparity(y, x) = static_cast<std::uint8_t>(label < used ? std::min(first + label, levels - 1) : 0);
    }
  }
  return map;
}

TEST(automaton, on_planes_equals_its_streaming_form_on_every_branch) {
  std::mt19937 random(31);
  test::branch_counts branches;
  constexpr int levels = 80;
  for (int repeat = 0; repeat < 1500; ++repeat) {
    const auto map = random_labels(random, levels);
    constexpr int rings[] = {1, 20, 24, 40};
    const int ring = repeat % 2 == 0 ? rings[repeat / 2 % 4] : 1 + static_cast<int>(random() % 40);
    const auto planes = automaton_rule_2(automaton_rule_1(map, levels), levels, ring);
    const auto streamed = test::streaming_automaton(map, branches).filter(ring);
    ASSERT_TRUE(equal(planes, streamed)) << "map " << repeat << ", ring " << ring;
  }
  for (const char* branch : test::automaton_branches) EXPECT_GE(branches[branch], 50) << branch;
  EXPECT_EQ(branches.size(), std::size(test::automaton_branches));
}

TEST(adaptive_ca, applies_the_automaton_when_asked) {
  std::mt19937 random(8);
  const grey left = random_grey(random, 20, 40, 256);
  grey right = random_grey(random, 20, 40, 256);
  right.leftCols(34) = left.rightCols(34);
  const adaptive_ca_parameters with{.levels = 10};
  const auto winners = adaptive_winners(colour_of(left), colour_of(right), with);
  EXPECT_TRUE(equal(adaptive_ca(colour_of(left), colour_of(right), {.levels = 10, .automaton = false}), winners));
  const auto filtered = adaptive_ca(colour_of(left), colour_of(right), with);
  EXPECT_TRUE(equal(filtered, automaton_rule_2(automaton_rule_1(winners, 10), 10, 24)));
  EXPECT_GT(filtered.defined.count(), 300);
  EXPECT_FALSE(filtered.defined.all());
}

}  // namespace
}  // namespace epiline::golden
