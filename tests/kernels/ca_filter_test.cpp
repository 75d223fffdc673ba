// The automaton's streaming form against one binary plane a level, on label maps that exercise every rule.
#include "kernels/ca_filter.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "brute_force_adaptive_ca.hpp"

namespace epiline::kernels {
namespace {

using test::disparity_map;
using test::undefined;

template <int Lanes>
struct config {
  static constexpr int max_width = 48;
  static constexpr int pixels_per_beat = Lanes;
};

/// Streams the map through the filter: undefined rows before and after it, undefined columns between its rows.
template <int Lanes>
disparity_map filtered(ca_filter<config<Lanes>>& filter, const disparity_map& map, int width, int height, bool enabled,
                       int ring) {
  using filter_t = ca_filter<config<Lanes>>;
  constexpr int delay_rows = filter_t::delay_rows;
  const int beats = (width + Lanes - 1) / Lanes;
  const int row_beats = std::max(beats + (3 + Lanes - 1) / Lanes, 8);
  disparity_map result;
  for (int step = 0; step < (3 + height + delay_rows) * row_beats + filter_t::delay_beats; ++step) {
    const int y = step / row_beats - 3;
    const int beat = step % row_beats;
    disparity_pixel newest[Lanes];
    typename filter_t::place at;
    at.beat = beat;
    at.in_columns = beat < beats;
    at.marks = {beat < beats && y >= delay_rows && y < height + delay_rows, y == delay_rows && beat == 0,
                beat == beats - 1};
    for (int lane = 0; lane < Lanes; ++lane) {
      const int x = beat * Lanes + lane;
      const bool inside = x < width && y >= 0 && y < height;
      const int label = inside ? map[static_cast<std::size_t>(y * width + x)] : undefined;
      newest[lane] = {label == undefined ? 0 : label, label != undefined, inside};
      at.in_frame[lane] = x < width && at.marks.in_frame;
    }
    const auto found = filter.step(newest, at, enabled, ring);
    if (!found.marks.in_frame) continue;
    const std::size_t column = result.size() % static_cast<std::size_t>(width);
    EXPECT_EQ(found.marks.first_beat, result.empty());
    EXPECT_EQ(found.marks.last_of_row, column + Lanes >= static_cast<std::size_t>(width));
    for (int lane = 0; lane < Lanes; ++lane) {
      const auto& pixel = found.pixel[lane];
      EXPECT_EQ(pixel.in_frame, column + static_cast<std::size_t>(lane) < static_cast<std::size_t>(width));
      if (pixel.in_frame) result.push_back(pixel.defined ? pixel.disparity.to_int() : undefined);
    }
  }
  return result;
}

/// Blobs of few levels, some noise, some holes: the fewer levels and the larger the blobs, the more rules agree.
disparity_map random_labels(std::mt19937& random, int width, int height, int levels) {
  const auto below = [&random](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  const int cell = 1 + below(6);
  const int noise = 1 + below(12);
  const int holes = 1 + below(20);
  std::vector<int> blobs(1024);
  for (auto& blob : blobs) blob = 127 - below(levels);
  disparity_map map;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int label = blobs[static_cast<std::size_t>((y / cell * 32 + x / cell) % 1024)];
      if (below(noise) == 0) label = 127 - below(levels);
      map.push_back(below(holes) == 0 ? undefined : label);
    }
  }
  return map;
}

template <class Lanes>
class ca_filter_of : public testing::Test {};
using lane_counts =
    testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(ca_filter_of, lane_counts);

TYPED_TEST(ca_filter_of, equals_binary_planes_for_every_ring) {
  constexpr int lanes = TypeParam::value;
  const auto filter = std::make_unique<ca_filter<config<lanes>>>();
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 160; ++repeat) {
    const int width = repeat % 10 == 0 ? 48 : 1 + static_cast<int>(random() % 48);
    const int height = 1 + static_cast<int>(random() % 20);
    const int ring = 1 + repeat % 40;
    const disparity_map map = random_labels(random, width, height, 1 + repeat % 5);
    ASSERT_EQ(filtered<lanes>(*filter, map, width, height, true, ring),
              test::brute_force_automaton(map, width, height, ring))
        << width << 'x' << height << ", ring " << ring << ", repeat " << repeat;
  }
}

TYPED_TEST(ca_filter_of, passes_labels_unchanged_when_off) {
  constexpr int lanes = TypeParam::value;
  const auto filter = std::make_unique<ca_filter<config<lanes>>>();
  std::mt19937 random(2);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const int width = 1 + static_cast<int>(random() % 48);
    const int height = 1 + static_cast<int>(random() % 20);
    const disparity_map map = random_labels(random, width, height, 3);
    ASSERT_EQ(filtered<lanes>(*filter, map, width, height, false, 1), map) << width << 'x' << height;
  }
}

/// What pixel (x, y) of a square map becomes; the map is `background` but for the listed pixels.
struct spot {
  int x, y, label;
};
int result_at(int x, int y, int size, int background, const std::vector<spot>& spots, int ring) {
  const auto index = [size](int column, int row) { return static_cast<std::size_t>(row * size + column); };
  disparity_map map(index(0, size), background);
  for (const spot& spot : spots) map[index(spot.x, spot.y)] = spot.label;
  const auto filter = std::make_unique<ca_filter<config<1>>>();
  const disparity_map result = filtered<1>(*filter, map, size, size, true, ring);
  EXPECT_EQ(result, test::brute_force_automaton(map, size, size, ring));
  return result[index(x, y)];
}

// Births are seen from two pixels to the right, where the pixels in question are cells of the ring.
TEST(ca_filter_rules, seven_equal_neighbours_give_birth_and_six_do_not) {
  EXPECT_EQ(result_at(7, 5, 11, 1, {{5, 5, 9}}, 40), 1) << "eight";
  EXPECT_EQ(result_at(7, 5, 11, 1, {{5, 5, 9}, {4, 5, undefined}}, 40), 1) << "seven";
  EXPECT_EQ(result_at(7, 5, 11, 1, {{5, 5, 9}, {4, 4, 9}, {4, 5, 9}}, 38), undefined) << "six";
  EXPECT_EQ(result_at(7, 5, 11, 1, {{5, 5, 9}, {4, 4, 9}, {4, 5, 9}}, 37), 1) << "six";
}

// The first neighbours of the window are the ones the streaming form looks for the majority in.
TEST(ca_filter_rules, birth_does_not_hang_on_which_neighbour_differs) {
  for (int y = 4; y <= 6; ++y) {
    for (int x = 4; x <= 6; ++x) {
      if (x == 5 && y == 5) continue;
      EXPECT_EQ(result_at(7, 5, 11, 1, {{5, 5, 9}, {x, y, undefined}}, 40), 1) << x << ' ' << y;
    }
  }
}

TEST(ca_filter_rules, a_pixel_without_an_equal_neighbour_dies) {
  EXPECT_EQ(result_at(5, 5, 11, undefined, {{5, 5, 3}, {8, 5, 3}, {8, 6, 3}}, 1), undefined);
  EXPECT_EQ(result_at(5, 5, 11, undefined, {{5, 5, 3}, {4, 4, 3}, {8, 5, 3}, {8, 6, 3}}, 2), 3);
}

TEST(ca_filter_rules, a_level_needs_the_ring_it_asks_for) {
  for (const int missing : {0, 1, 5}) {
    std::vector<spot> holes;
    for (int i = 0; i < missing; ++i) holes.push_back({2, 2 + i, undefined});
    for (int i = 0; i < missing; ++i) holes.push_back({1, 2 + i, undefined});  // two wide, so that no hole is filled
    EXPECT_EQ(result_at(5, 5, 11, 2, holes, 40 - missing), 2) << missing;
    if (missing > 1) {
      EXPECT_EQ(result_at(5, 5, 11, 2, holes, 41 - missing), undefined) << missing;
    }
  }
}

TEST(ca_filter_rules, a_pixel_claimed_by_two_levels_stays_undefined) {
  std::vector<spot> right_part;
  for (int y = 0; y < 9; ++y) {
    for (int x = 5; x < 9; ++x) right_part.push_back({x, y, 4});
  }
  // Of the ring around (4, 4) 22 cells hold 3 and 18 hold 4.
  EXPECT_EQ(result_at(4, 4, 9, 3, right_part, 18), undefined);
  EXPECT_EQ(result_at(4, 4, 9, 3, right_part, 19), 3);
  EXPECT_EQ(result_at(4, 4, 9, 3, right_part, 22), 3);
  EXPECT_EQ(result_at(4, 4, 9, 3, right_part, 23), undefined);
}

TEST(ca_filter_rules, the_largest_disparity_and_zero_are_levels_like_others) {
  EXPECT_EQ(result_at(5, 5, 11, 0, {{5, 5, 9}}, 40), 0);
  EXPECT_EQ(result_at(5, 5, 11, 127, {{5, 5, 0}}, 40), 127);
}

}  // namespace
}  // namespace epiline::kernels
