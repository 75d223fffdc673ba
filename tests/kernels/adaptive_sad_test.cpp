// Adaptive SAD alone against brute force: every window, every candidate, whatever the pixel's neighbours chose.
#include "kernels/adaptive_sad.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "brute_force_adaptive_ca.hpp"

namespace epiline::kernels {
namespace {

template <int Lanes, int ParallelDisparities = all_levels>
struct config {
  static constexpr int max_width = 40;
  static constexpr int levels = 9;
  static constexpr int parallel_disparities = ParallelDisparities;
  static constexpr int pixels_per_beat = Lanes;
};

template <class Config>
class adaptive_sad_of : public testing::Test {};
using configs = testing::Types<config<1>, config<2>, config<4>, config<1, 3>, config<1, 1>>;
TYPED_TEST_SUITE(adaptive_sad_of, configs);

/// Walks over the frame as the top does, with frames of different sizes one after another in one object.
TYPED_TEST(adaptive_sad_of, equals_brute_force_for_every_candidate_and_window) {
  using sad = adaptive_sad<TypeParam>;
  constexpr int lanes = TypeParam::pixels_per_beat;
  constexpr int radius = sad::window_radius;
  const auto lines = std::make_unique<luma_rows<TypeParam, sad::window_rows>>();
  const auto matcher = std::make_unique<sad>();
  std::mt19937 random(1);
  for (int frame = 0; frame < 12; ++frame) {
    const int width = frame == 0 ? TypeParam::max_width : 1 + static_cast<int>(random() % TypeParam::max_width);
    const int height = 1 + static_cast<int>(random() % 16);
    const test::stereo_pair pair = test::random_pair(random, width, height, 5, 30);
    const int beats = (width + lanes - 1) / lanes;
    const int row_beats = std::max(beats + (sad::delay_columns + lanes - 1) / lanes, 8);
    for (int row = 0; row < height + radius; ++row) {
      for (int beat = 0; beat < row_beats; ++beat) {
        ap_uint<24 * lanes> left = 0;
        ap_uint<24 * lanes> right = 0;
        typename sad::place at;
        at.column.beat = beat;
        at.column.in_columns = beat < beats;
        at.column.first_row = row == 0;
        at.row_starts = beat == 0;
        for (int k = 0; k < sad::window_rows; ++k) at.row_in[k] = row >= k;
        int radius_of_lane[lanes];
        window_choice_t choice[lanes];
        for (int lane = 0; lane < lanes; ++lane) {
          const int x = beat * lanes + lane;
          at.column.lane_in[lane] = x < width;
          radius_of_lane[lane] = 1 + static_cast<int>(random() % 3);
          choice[lane] = window_3x3 + radius_of_lane[lane] - 1;
          for (int c = 0; c < 3 && row < height && beat < beats; ++c) {
            const int low = 24 * lane + 8 * c;
            left.range(low + 7, low) = x < width ? pair.left.at(x, row, c) : 99;
            right.range(low + 7, low) = x < width ? pair.right.at(x, row, c) : 7;
          }
        }
        const auto columns = lines->step(left, right, beat, beat < beats);
        for (int group = 0; group < at.group.count; ++group) {
          const auto costs = matcher->step(columns.left, columns.right, at, choice);
          at.group.advance();
          for (int lane = 0; lane < lanes; ++lane) {
            const int x = beat * lanes + lane - sad::delay_columns;
            const int y = row - radius;
            if (x < 0 || x >= width || y < 0) continue;
            for (int i = 0; i < sad::levels; ++i) {
              const int d = group * sad::levels + i;
              if (d > x) break;
              ASSERT_EQ(costs.at[lane][i], test::luma_cost(pair, x, y, d, radius_of_lane[lane]))
                  << "frame " << frame << ' ' << width << 'x' << height << ", x " << x << ", y " << y << ", d " << d
                  << ", radius " << radius_of_lane[lane];
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace epiline::kernels
