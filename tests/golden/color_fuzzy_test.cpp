#include "golden/color_fuzzy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <random>
#include <vector>

namespace epiline::golden {
namespace {

colour_image grey_image(int rows, int columns, std::uint8_t value) {
  const plane<std::uint8_t> grey = plane<std::uint8_t>::Constant(rows, columns, value);
  return {grey, grey, grey};
}

constexpr operand none{};
constexpr operand some(int disparity) { return {disparity, true}; }

TEST(aggregated_cost, of_white_against_black_counts_the_pixels_of_the_window_inside_the_image) {
  const auto cost = aggregated_cost(grey_image(9, 11, 255), grey_image(9, 11, 0), 0);
  EXPECT_EQ(cost(4, 5), 49 * 765);  // 37485, the largest cost there is
  EXPECT_EQ(cost(0, 0), 16 * 765);
  EXPECT_EQ(cost(0, 5), 28 * 765);
  EXPECT_EQ(cost(8, 10), 16 * 765);
  EXPECT_EQ(cost(1, 2), 5 * 6 * 765);
}

TEST(aggregated_cost, adds_the_three_colours_within_three_pixels) {
  const colour_image left = grey_image(9, 9, 100);
  colour_image right = left;
  right.red(4, 4) = 90;     // 10 below
  right.green(4, 4) = 120;  // 20 above
  right.blue(4, 4) = 105;   // 5 above
  const auto cost = aggregated_cost(left, right, 0);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) EXPECT_EQ(cost(y, x), std::abs(y - 4) <= 3 && std::abs(x - 4) <= 3 ? 35 : 0);
  }
}

TEST(aggregated_cost, takes_column_0_for_right_pixels_left_of_the_image) {
  const colour_image left = grey_image(1, 9, 0);
  colour_image right = left;
  right.red(0, 0) = right.green(0, 0) = right.blue(0, 0) = 10;
  // At d = 2 the left columns 0, 1 and 2 meet right column 0 and cost 30 each.
  const auto cost = aggregated_cost(left, right, 2);
  const std::vector<int> expected{90, 90, 90, 90, 60, 30, 0, 0, 0};
  for (int x = 0; x < 9; ++x) EXPECT_EQ(cost(0, x), expected[static_cast<std::size_t>(x)]) << x;
  // Wider than the image: every column meets column 0.
  EXPECT_EQ(aggregated_cost(left, right, 20)(0, 4), 7 * 30);
}

TEST(confident_winners, takes_the_smallest_disparity_of_a_tie) {
  const colour_image flat = grey_image(10, 20, 50);
  const auto map = confident_winners(flat, flat, {.levels = 8});
  EXPECT_TRUE((map.disparity == 0).all());
  EXPECT_TRUE(map.defined.all());  // 16 * 0 >= 17 * 0
}

TEST(confident_winners, finds_a_shift_where_the_right_image_shows_it) {
  std::mt19937 random(5);
  colour_image left = grey_image(12, 40, 0);
  for (auto* colour : {&left.red, &left.green, &left.blue}) {
    *colour = colour->unaryExpr([&](std::uint8_t) { return static_cast<std::uint8_t>(random() % 256); }).eval();
  }
  colour_image right = left;  // right(x) = left(x + 5)
  for (auto* colour : {&right.red, &right.green, &right.blue}) {
    colour->leftCols(35) = colour->rightCols(35).eval();
  }
  const auto map = confident_winners(left, right, {.levels = 16});
  EXPECT_TRUE((map.disparity.middleCols(8, 29) == 5).all());
  EXPECT_TRUE(map.defined.middleCols(8, 29).all());
  // Its right pixel would lie outside the image: no level above x is allowed.
  for (int x = 0; x < 5; ++x) EXPECT_LE(map.disparity.col(x).maxCoeff(), x);
}

// ---- the same definitions once more, one pixel at a time
// ---------------------------------------------------------------

int naive_cost(const colour_image& left, const colour_image& right, int y, int x, int d) {
  int sum = 0;
  for (int j = std::max(y - 3, 0); j <= std::min<int>(y + 3, static_cast<int>(left.red.rows()) - 1); ++j) {
    for (int i = std::max(x - 3, 0); i <= std::min<int>(x + 3, static_cast<int>(left.red.cols()) - 1); ++i) {
      const int k = std::max(i - d, 0);
      sum += std::abs(left.red(j, i) - right.red(j, k)) + std::abs(left.green(j, i) - right.green(j, k)) +
             std::abs(left.blue(j, i) - right.blue(j, k));
    }
  }
  return sum;
}

operand naive_winner(const colour_image& left, const colour_image& right, int y, int x,
                     const color_fuzzy_parameters& with) {
  const int columns = static_cast<int>(left.red.cols());
  int winner = 0;
  for (int d = 1; d < with.levels && d <= x; ++d) {
    if (naive_cost(left, right, y, x, d) < naive_cost(left, right, y, x, winner)) winner = d;
  }
  if (with.uniqueness != 0) {
    for (int d = 0; d < with.levels && d <= x; ++d) {
      if (std::abs(d - winner) > 1 &&
          16 * naive_cost(left, right, y, x, d) < with.uniqueness * naive_cost(left, right, y, x, winner)) {
        return none;
      }
    }
  }
  if (with.left_right) {
    const int right_x = x - winner;
    int of_right = 0;
    for (int d = 1; d < with.levels && right_x + d < columns; ++d) {
      if (naive_cost(left, right, y, right_x + d, d) < naive_cost(left, right, y, right_x + of_right, of_right)) {
        of_right = d;
      }
    }
    if (std::abs(winner - of_right) > 1) return none;
  }
  return some(winner);
}

TEST(confident_winners, agrees_with_the_definitions_pixel_by_pixel) {
  std::mt19937 random(11);
  int undefined = 0;
  int defined = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int rows = 1 + static_cast<int>(random() % 10);
    const int columns = 1 + static_cast<int>(random() % 24);
    const unsigned greys = repeat % 3 == 0 ? 2 : 256;  // two values: many ties
    colour_image left = grey_image(rows, columns, 0);
    colour_image right = left;
    for (auto* colour : {&left.red, &left.green, &left.blue, &right.red, &right.green, &right.blue}) {
      *colour = colour->unaryExpr([&](std::uint8_t) { return static_cast<std::uint8_t>(random() % greys); }).eval();
    }
    const color_fuzzy_parameters with{.levels = 1 + static_cast<int>(random() % 30),
                                      .left_right = random() % 2 == 0,
                                      .uniqueness = random() % 2 == 0 ? 0 : 16 + static_cast<int>(random() % 8)};
    const auto map = confident_winners(left, right, with);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const operand expected = naive_winner(left, right, y, x, with);
        ASSERT_EQ(map.defined(y, x), expected.defined) << rows << "x" << columns << " at " << y << "," << x;
        ASSERT_EQ(map.disparity(y, x), expected.disparity) << rows << "x" << columns << " at " << y << "," << x;
        ++(expected.defined ? defined : undefined);
      }
    }
  }
  // Both answers were common.
  EXPECT_GT(defined, 300);
  EXPECT_GT(undefined, 300);
}

// ---- fuzzy inference
// ---------------------------------------------------------------------------------------------------

struct inference_case {
  operand centre, left, right, expected, careful;
};

TEST(infer, follows_the_rule_table) {
  const inference_case cases[] = {
      // centre, left, right, result, result with careful fill
      {some(10), some(10), some(10), some(10), some(10)},  // all agree
      {some(10), some(12), some(10), some(10), some(10)},  // one neighbour agrees
      {some(10), some(10), some(90), some(10), some(10)},
      {some(10), some(12), some(12), some(12), some(12)},  // near both, and they agree: the neighbours
      {some(10), some(8), some(8), some(8), some(8)},      // also when they are lower
      {some(10), some(11), some(11), some(11), some(11)},  // N, N, S at 32 against C at 31
      {some(10), some(12), some(8), some(10), some(10)},   // near both, but they are far apart
      {some(10), some(12), some(13), some(10), some(10)},  // C at 32 against N at 31
      {some(10), some(13), some(12), some(10), some(10)},
      {some(10), some(13), some(13), some(13), some(13)},
      {some(10), some(20), some(12), some(10), some(10)},  // F, N, F
      {some(10), some(20), some(20), some(20), some(20)},  // far from both, and they agree
      {some(10), some(20), some(18), some(20), some(20)},  // the larger of the two
      {some(10), some(18), some(20), some(20), some(20)},
      {some(10), some(13), some(14), some(14), some(14)},
      {some(10), some(20), some(24), none, none},  // nobody agrees
      {some(10), some(13), some(7), none, none},
      // a difference with an undefined operand is far
      {some(10), none, some(10), some(10), some(10)},
      {some(10), none, some(12), some(10), some(10)},
      {some(10), none, some(13), none, none},
      {some(10), some(14), none, none, none},
      {some(10), none, none, none, none},
      // undefined centre
      {none, some(10), some(10), some(10), some(10)},
      {none, some(10), some(12), some(12), some(12)},
      {none, some(13), some(10), some(10), none},  // F(3) = 32 is not below 32
      {none, some(10), some(40), some(10), none},
      {none, some(0), some(90), some(0), none},
      {none, some(7), none, some(7), none},
      {none, none, some(0), some(0), none},
      {none, none, none, none, none},
  };
  for (const auto& c : cases) {
    const auto where = testing::Message() << c.centre.defined << c.centre.disparity << " l " << c.left.defined
                                          << c.left.disparity << " r " << c.right.defined << c.right.disparity;
    EXPECT_EQ(infer(c.centre, c.left, c.right, false), c.expected) << where;
    EXPECT_EQ(infer(c.centre, c.left, c.right, true), c.careful) << where;
  }
}

TEST(infer, gives_only_an_operands_disparity_and_ignores_a_mirrored_neighbourhood) {
  std::mt19937 random(3);
  const auto any = [&] { return random() % 5 == 0 ? none : some(static_cast<int>(random() % 12)); };
  for (int i = 0; i < 5000; ++i) {
    const operand c = any();
    const operand l = any();
    const operand r = any();
    const operand result = infer(c, l, r, false);
    EXPECT_EQ(result, infer(c, r, l, false));
    EXPECT_TRUE(!result.defined || result == c || result == l || result == r);
  }
}

TEST(fuzzy_filter, looks_three_columns_to_each_side_and_takes_the_outside_as_undefined) {
  disparity_plane map{plane<std::uint8_t>::Zero(2, 9), plane<bool>::Constant(2, 9, false)};
  map.disparity(0, 4) = 30;
  map.defined(0, 4) = true;
  const auto filled = fuzzy_filter(map, false);
  // The lone pixel fills both pixels three columns away and vanishes itself, as nobody agrees with it.
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool expected = y == 0 && (x == 1 || x == 7);
      EXPECT_EQ(filled.defined(y, x), expected) << y << "," << x;
      EXPECT_EQ(filled.disparity(y, x), expected ? 30 : 0) << y << "," << x;
    }
  }
  EXPECT_FALSE(fuzzy_filter(map, true).defined.any());
}

TEST(color_fuzzy, applies_as_many_passes_as_asked_for) {
  std::mt19937 random(8);
  colour_image left = grey_image(8, 30, 0);
  colour_image right = left;
  for (auto* colour : {&left.red, &left.green, &left.blue, &right.red, &right.green, &right.blue}) {
    *colour = colour->unaryExpr([&](std::uint8_t) { return static_cast<std::uint8_t>(random() % 256); }).eval();
  }
  disparity_plane expected = confident_winners(left, right, {.levels = 10});
  for (int passes = 0; passes <= 2; ++passes) {
    const auto map = color_fuzzy(left, right, {.levels = 10, .fuzzy = passes});
    EXPECT_TRUE((map.disparity == expected.disparity).all() && (map.defined == expected.defined).all()) << passes;
    const auto next = fuzzy_filter(expected, false);
    EXPECT_FALSE((next.disparity == expected.disparity).all() && (next.defined == expected.defined).all()) << passes;
    expected = next;
  }
}

}  // namespace
}  // namespace epiline::golden
