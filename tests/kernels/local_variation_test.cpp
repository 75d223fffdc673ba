// Local variation alone and against brute force: both measures, the borders, the choice of the window.
#include "kernels/local_variation.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "brute_force_adaptive_ca.hpp"

namespace epiline::kernels {
namespace {

TEST(luma_of, weighs_green_twice_and_rounds) {
  EXPECT_EQ(luma_of({255, 255, 255}), 255);
  EXPECT_EQ(luma_of({1, 0, 0}), 0);
  EXPECT_EQ(luma_of({0, 1, 0}), 1);
  EXPECT_EQ(luma_of({0, 0, 2}), 1);
  EXPECT_EQ(luma_of({200, 0, 0}), 50);
  EXPECT_EQ(luma_of({0, 200, 0}), 100);
  EXPECT_EQ(luma_of({0, 0, 200}), 50);
}

template <int Lanes>
struct config {
  static constexpr int pixels_per_beat = Lanes;
};

/// Calls `body(kernel, lane, x, y)` for every pixel of the picture, when the kernel stands there.
template <int Lanes, class Body>
void walk(const test::picture& left, Body body) {
  constexpr int delay_columns = 3;
  using kernel_t = local_variation<config<Lanes>, delay_columns>;
  const auto kernel = std::make_unique<kernel_t>();
  const int beats = (left.width + Lanes - 1) / Lanes;
  for (int y = 0; y < left.height; ++y) {
    for (int beat = 0; beat < beats + delay_columns; ++beat) {
      typename kernel_t::place at;
      luma_t newest[kernel_t::rows][Lanes];
      for (int row = 0; row < kernel_t::rows; ++row) {
        const int from = y + row - 2;
        at.row_in[row] = from >= 0 && from < left.height;
        for (int lane = 0; lane < Lanes; ++lane) {
          const int x = beat * Lanes + lane;
          const bool inside = at.row_in[row] && x < left.width;
          newest[row][lane] = inside ? test::luma(left, x, from) : 77;  // what lies outside must not matter
        }
      }
      for (int lane = 0; lane < Lanes; ++lane) at.lane_in[lane] = beat * Lanes + lane < left.width;
      at.row_starts = beat == 0;
      kernel->step(newest, at);
      for (int lane = 0; lane < Lanes; ++lane) {
        const int x = beat * Lanes + lane - delay_columns;
        if (x >= 0 && x < left.width) body(*kernel, lane, x, y);
      }
    }
  }
}

template <int Lanes>
void expect_brute_force() {
  std::mt19937 random(1);
  for (int size = 1; size <= 12; ++size) {
    const test::picture left = test::random_pair(random, size, 13 - size, 0, 0).left;
    walk<Lanes>(left, [&](const auto& kernel, int lane, int x, int y) {
      ASSERT_EQ(kernel.lv2(lane), test::brute_force_variation(left, x, x + 1, y, y + 1))
          << size << ' ' << x << ' ' << y;
      ASSERT_EQ(kernel.lv5(lane), test::brute_force_variation(left, x - 2, x + 2, y - 2, y + 2))
          << size << ' ' << x << ' ' << y;
    });
  }
}

TEST(local_variation, equals_brute_force_with_one_pixel_a_beat) { expect_brute_force<1>(); }
TEST(local_variation, equals_brute_force_with_two_pixels_a_beat) { expect_brute_force<2>(); }
TEST(local_variation, equals_brute_force_with_four_pixels_a_beat) { expect_brute_force<4>(); }

TEST(local_variation, chooses_strictly_above_a_threshold) {
  std::mt19937 random(2);
  int chosen[3] = {0, 0, 0};
  for (int frame = 0; frame < 40; ++frame) {
    const test::picture left = test::random_pair(random, 9, 9, 0, 0).left;
    walk<1>(left, [&](const auto& kernel, int lane, int x, int y) {
      const int lv2 = test::brute_force_variation(left, x, x + 1, y, y + 1);
      const int lv5 = test::brute_force_variation(left, x - 2, x + 2, y - 2, y + 2);
      // The thresholds at the measures themselves: the largest that lies below, and the next.
      for (const int t2 : {(lv2 - 1) / 4, (lv2 + 3) / 4, 255}) {
        for (const int t5 : {(lv5 - 1) / 25, (lv5 + 24) / 25, 3182}) {
          if (t2 < 0 || t2 > 255 || t5 < 0 || t5 > 3182) continue;
          const int expected = lv2 > 4 * t2 ? window_3x3 : lv5 > 25 * t5 ? window_5x5 : window_7x7;
          ASSERT_EQ(kernel.choice(lane, t2, t5), expected) << lv2 << ' ' << t2 << ' ' << lv5 << ' ' << t5;
          ++chosen[expected];
        }
      }
    });
  }
  for (const int count : chosen) EXPECT_GT(count, 100);
}

TEST(local_variation, holds_the_largest_measures) {
  // Half black, half white is the most any window can vary.
  test::picture two_by_two{2, 2, {}};
  for (const int value : {255, 0, 0, 255})
    two_by_two.channels.insert(two_by_two.channels.end(), 3, static_cast<std::uint8_t>(value));
  walk<1>(two_by_two, [](const auto& kernel, int lane, int x, int y) {
    if (x == 0 && y == 0) {
      EXPECT_EQ(kernel.lv2(lane), 2040);
    }
  });
  test::picture five_by_five{5, 5, {}};
  for (int i = 0; i < 25; ++i)
    five_by_five.channels.insert(five_by_five.channels.end(), 3, static_cast<std::uint8_t>(i < 12 ? 255 : 0));
  walk<1>(five_by_five, [](const auto& kernel, int lane, int x, int y) {
    if (x == 2 && y == 2) {
      EXPECT_EQ(kernel.lv5(lane), 2 * 12 * 13 * 255);
    }
  });
}

}  // namespace
}  // namespace epiline::kernels
