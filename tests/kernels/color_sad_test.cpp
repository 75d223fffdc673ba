// Colour SAD and what it is made of, each alone and against brute force.
#include "kernels/color_sad.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "brute_force.hpp"
#include "kernels/candidates.hpp"
#include "kernels/level_delay.hpp"

namespace epiline::kernels {
namespace {

using test::random_pair;
using test::stereo_pair;

TEST(absolute_difference, of_all_pairs) {
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) ASSERT_EQ(absolute_difference(a, b), std::abs(a - b));
  }
}

TEST(color_of_lane, has_red_lowest) {
  const ap_uint<48> beat("0x665544332211");
  EXPECT_EQ(color_of_lane(beat, 0).red, 0x11);
  EXPECT_EQ(color_of_lane(beat, 0).green, 0x22);
  EXPECT_EQ(color_of_lane(beat, 0).blue, 0x33);
  EXPECT_EQ(color_of_lane(beat, 1).red, 0x44);
  EXPECT_EQ(color_of_lane(beat, 1).green, 0x55);
  EXPECT_EQ(color_of_lane(beat, 1).blue, 0x66);
}

template <int Lanes>
void expect_taps() {
  constexpr int length = Lanes + 9;
  constexpr int border = 3;
  pixel_taps<Lanes, length, border> taps{};
  for (int row = 0; row < 3; ++row) {
    for (int x = 0; x < 24; x += Lanes) {
      color beat[Lanes];
      for (int lane = 0; lane < Lanes; ++lane) beat[lane] = {row * 80 + x + lane, x + lane, 255 - x - lane};
      taps.step(beat, x == 0);
      for (int tap = 0; tap < length; ++tap) {
        const int column = x + Lanes - 1 - tap;
        if (column < -border) continue;
        const int pixel = std::max(column, 0);
        EXPECT_EQ(taps.red.tap[tap], row * 80 + pixel) << Lanes << ' ' << x << ' ' << tap;
        EXPECT_EQ(taps.green.tap[tap], pixel);
        EXPECT_EQ(taps.blue.tap[tap], 255 - pixel);
      }
    }
  }
}

TEST(pixel_taps, repeat_the_first_pixel_left_of_the_row) {
  expect_taps<1>();
  expect_taps<2>();
  expect_taps<4>();
}

template <int Length>
void expect_level_delay() {
  using delay = level_delay<ap_uint<9>, 2, Length>;
  const auto line = std::make_unique<delay>();
  for (int step = 1; step < 3 * Length + 5; ++step) {
    typename delay::values newest;
    newest.at[0][0] = step;
    newest.at[0][1] = 2 * step;
    const auto oldest = line->step(newest);
    const int then = std::max(step - Length, 0);
    ASSERT_EQ(oldest.at[0][0], then) << "length " << Length << ", step " << step;
    ASSERT_EQ(oldest.at[0][1], 2 * then);
  }
}

TEST(level_delay, starts_with_zeros) {
  expect_level_delay<0>();
  expect_level_delay<1>();
  expect_level_delay<16>();
  expect_level_delay<17>();
  expect_level_delay<40>();
}

template <int Lanes, int Radius, int ParallelDisparities = all_levels,
          window::row_memory Memory = window::row_memory::side_by_side>
struct config {
  static constexpr int max_width = 40;
  static constexpr int levels = 9;
  static constexpr int parallel_disparities = ParallelDisparities;
  static constexpr window::row_memory row_memory = Memory;
  static constexpr int pixels_per_beat = Lanes;
  static constexpr int window_radius = Radius;
};

template <class Config>
class color_sad_of : public testing::Test {};
using configs = testing::Types<config<1, 3>, config<2, 3>, config<4, 3>, config<1, 1>, config<2, 1>, config<1, 2>,
                               config<4, 2>, config<2, 0>, config<1, 3, 3>, config<1, 3, 1>, config<1, 2, 9>,
                               config<1, 3, 3, window::row_memory::one_after_another>,
                               config<2, 3, all_levels, window::row_memory::one_after_another>>;
TYPED_TEST_SUITE(color_sad_of, configs);

/// Walks over the frame as the top does, with frames of different sizes one after another in one object.
TYPED_TEST(color_sad_of, equals_brute_force_for_every_candidate) {
  using sad = color_sad<TypeParam>;
  constexpr int lanes = TypeParam::pixels_per_beat;
  constexpr int radius = TypeParam::window_radius;
  const auto matcher = std::make_unique<sad>();
  std::mt19937 random(1);
  for (int frame = 0; frame < 12; ++frame) {
    const int width = frame == 0 ? TypeParam::max_width : 1 + static_cast<int>(random() % TypeParam::max_width);
    const int height = 1 + static_cast<int>(random() % 16);
    const stereo_pair pair = random_pair(random, width, height, 5, 30);
    const int beats = (width + lanes - 1) / lanes;
    const int row_beats = std::max(beats + sad::delay_beats, 8);
    for (int row = 0; row < height + radius; ++row) {
      for (int beat = 0; beat < row_beats; ++beat) {
        typename sad::beat_t left = 0;
        typename sad::beat_t right = 0;
        typename sad::place at;
        at.column.beat = beat;
        at.column.in_columns = beat < beats;
        at.column.first_row = row == 0;
        at.row_starts = beat == 0;
        at.row_can_leave = row >= sad::window_rows;
        for (int lane = 0; lane < lanes; ++lane) {
          const int x = beat * lanes + lane;
          at.column.lane_in[lane] = x < width;
          for (int c = 0; c < 3 && row < height && beat < beats; ++c) {
            const int low = 24 * lane + 8 * c;
            left.range(low + 7, low) = x < width ? pair.left.at(x, row, c) : 99;
            right.range(low + 7, low) = x < width ? pair.right.at(x, row, c) : 7;
          }
        }
        for (int group = 0; group < at.group.count; ++group) {
          const auto costs = group == 0 ? matcher->step(left, right, at) : matcher->step(99, 99, at);
          for (int lane = 0; lane < lanes; ++lane) {
            const int x = (beat - sad::delay_beats) * lanes + lane;
            const int y = row - radius;
            if (x < 0 || x >= width || y < 0) continue;
            for (int i = 0; i < sad::levels; ++i) {
              const int d = group * sad::levels + i;
              if (d > x) break;
              ASSERT_EQ(costs.at[lane][i], test::window_cost(pair, x, y, d, radius))
                  << "frame " << frame << ' ' << width << 'x' << height << ", x " << x << ", y " << y << ", d " << d;
            }
          }
          at.group.advance();
        }
      }
    }
  }
}

/// `masked`: what a cost of 5 becomes that does not take part.
template <int Penalty>
void expect_masked(int masked) {
  using two_lanes = config<2, 3>;
  using costs_t = color_sad<two_lanes>::costs;
  costs_t costs;
  for (auto& lane : costs.at) std::fill(std::begin(lane), std::end(lane), ap_uint<16>(5));
  for (int levels = 1; levels <= two_lanes::levels; ++levels) {
    for (int x = 0; x < 40; x += 2) {
      for (int in_frame = 0; in_frame < 4; ++in_frame) {
        const bool pixel_in[2] = {(in_frame & 1) != 0, (in_frame & 2) != 0};
        const costs_t result =
            candidate_mask<two_lanes, costs_t, Penalty>::step(costs, ap_uint<11>(x), pixel_in, ap_uint<4>(levels));
        for (int lane = 0; lane < 2; ++lane) {
          for (int d = 0; d < two_lanes::levels; ++d) {
            const bool allowed = pixel_in[lane] && d <= x + lane && d < levels;
            EXPECT_EQ(result.at[lane][d], allowed ? 5 : masked) << levels << ' ' << x << ' ' << lane << ' ' << d;
          }
        }
      }
    }
  }
}

TEST(candidate_mask, keeps_exactly_the_allowed_candidates) {
  expect_masked<65535>(65535);
  expect_masked<32768>(32768 + 5);
}

}  // namespace
}  // namespace epiline::kernels
