// Uniqueness and left-right check, each alone, on random costs with many ties.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "kernels/left_right_check.hpp"
#include "kernels/right_winner.hpp"
#include "kernels/uniqueness.hpp"

namespace epiline::kernels {
namespace {

template <int Lanes, int Levels, int ParallelDisparities = all_levels>
struct config {
  static constexpr int max_width = 64;
  static constexpr int levels = Levels;
  static constexpr int parallel_disparities = ParallelDisparities;
  static constexpr window::row_memory row_memory = window::row_memory::side_by_side;
  static constexpr int pixels_per_beat = Lanes;
  static constexpr int window_radius = 3;
  static constexpr int uniqueness_delay = Lanes == 2 && ParallelDisparities == all_levels ? 0 : 11;
};

/// A raster of padded rows: costs[column][d], 65535 where d > x, outside the frame or from a level that takes no part.
template <class Config>
struct raster_of_costs {
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int levels = Config::levels;
  struct column {
    bool in_frame = false;
    int x = 0;
    std::vector<int> costs = std::vector<int>(levels, 65535);
    int winner = 0;
  };
  std::vector<column> columns;
  std::mt19937 random{static_cast<unsigned>(lanes * 1000 + levels)};

  int below(int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); }

  raster_of_costs() {
    for (int row = 0; row < 12; ++row) {
      const int width = 1 + below(Config::max_width);
      const int levels_used = 1 + below(levels);
      const int range = row % 2 == 0 ? 5 : 37486;
      for (int x = 0; x < (width + lanes - 1) / lanes * lanes + 8; ++x) {
        column next;
        next.in_frame = x < width;
        next.x = x;
        for (int d = 0; d < levels_used && d <= x && x < width; ++d)
          next.costs[static_cast<std::size_t>(d)] = below(range);
        // Any level may be the winner here: the checks do not depend on how it was chosen.
        next.winner = next.in_frame ? below(std::min(levels_used, x + 1)) : 0;
        columns.push_back(next);
      }
    }
  }

  [[nodiscard]] int beats() const { return static_cast<int>(columns.size()) / lanes; }

  /// Beats after the last one are empty.
  [[nodiscard]] column at(int beat, int lane) const {
    return beat < beats() ? columns[static_cast<std::size_t>(beat * lanes + lane)] : column{};
  }
  [[nodiscard]] typename right_winner<Config>::costs_t costs(int beat, int group) const {
    typename right_winner<Config>::costs_t result;
    constexpr int size = level_groups<Config>::size;
    for (int lane = 0; lane < lanes; ++lane) {
      for (int i = 0; i < size; ++i) {
        result.at[lane][i] = at(beat, lane).costs[static_cast<std::size_t>(group * size + i)];
      }
    }
    return result;
  }
  [[nodiscard]] disparity_beat_of<lanes> found(int beat) const {
    disparity_beat_of<lanes> result;
    for (int lane = 0; lane < lanes; ++lane) {
      const column here = at(beat, lane);
      result.pixel[lane] = {here.winner, here.in_frame, here.in_frame};
    }
    result.marks = {beat % 2, beat % 3 == 0, beat % 5 == 0};
    return result;
  }
  /// dR at a column of the raster.
  [[nodiscard]] int right_disparity(int index) const {
    int best = 0;
    int lowest = 65536;
    for (int d = 0; d < levels && index + d < static_cast<int>(columns.size()); ++d) {
      const column& partner = columns[static_cast<std::size_t>(index + d)];
      if (partner.x - d != columns[static_cast<std::size_t>(index)].x || !partner.in_frame) break;
      if (partner.costs[static_cast<std::size_t>(d)] < lowest) {
        lowest = partner.costs[static_cast<std::size_t>(d)];
        best = d;
      }
    }
    return best;
  }
};

void expect_marks(const beat_marks& marks, int beat) {
  EXPECT_EQ(marks.in_frame, beat % 2);
  EXPECT_EQ(marks.first_beat, beat % 3 == 0);
  EXPECT_EQ(marks.last_of_row, beat % 5 == 0);
}

template <class Config>
class confidence : public testing::Test {};
using configs = testing::Types<config<1, 1>, config<1, 2>, config<1, 9>, config<1, 80>, config<2, 1>, config<2, 8>,
                               config<2, 9>, config<2, 128>, config<4, 2>, config<4, 8>, config<4, 13>, config<4, 80>,
                               config<1, 8, 4>, config<1, 9, 3>, config<1, 8, 1>, config<1, 80, 16>>;
TYPED_TEST_SUITE(confidence, configs);

TYPED_TEST(confidence, right_winner_is_the_first_smallest_of_its_diagonal) {
  const raster_of_costs<TypeParam> raster;
  using chain = right_winner<TypeParam>;
  chain right{};
  level_group<TypeParam> group;
  for (int beat = 0; beat < raster.beats() + chain::delay_beats; ++beat) {
    auto winners = right.step(raster.costs(beat, 0), group);
    for (group.advance(); !group.first(); group.advance()) {
      winners = right.step(raster.costs(beat, group.index()), group);
    }
    for (int lane = 0; lane < chain::lanes; ++lane) {
      const int index = (beat - chain::delay_beats) * chain::lanes + lane;
      if (index < 0 || !raster.columns[static_cast<std::size_t>(index)].in_frame) continue;
      ASSERT_EQ(winners.disparity[lane], raster.right_disparity(index)) << "column " << index;
    }
  }
}

TYPED_TEST(confidence, left_right_check_keeps_what_agrees_within_one_level) {
  const raster_of_costs<TypeParam> raster;
  using check_t = left_right_check<TypeParam>;
  for (const bool enabled : {true, false}) {
    const auto check = std::make_unique<check_t>();
    level_group<TypeParam> group;
    int kept = 0;
    int dropped = 0;
    for (int beat = 0; beat < raster.beats() + check_t::delay_beats; ++beat) {
      auto checked = check->step(raster.costs(beat, 0), raster.found(beat), enabled, group);
      for (group.advance(); !group.first(); group.advance()) {
        checked = check->step(raster.costs(beat, group.index()), raster.found(beat), enabled, group);
      }
      const int then = beat - check_t::delay_beats;
      if (then < 0) continue;
      expect_marks(checked.marks, then);
      for (int lane = 0; lane < check_t::lanes; ++lane) {
        const int index = then * check_t::lanes + lane;
        const auto& column = raster.columns[static_cast<std::size_t>(index)];
        ASSERT_EQ(checked.pixel[lane].disparity, column.winner);
        ASSERT_EQ(checked.pixel[lane].in_frame, column.in_frame);
        if (!column.in_frame) {
          ASSERT_EQ(checked.pixel[lane].defined, 0);
          continue;
        }
        const bool agrees = std::abs(column.winner - raster.right_disparity(index - column.winner)) <= 1;
        ASSERT_EQ(checked.pixel[lane].defined, agrees || !enabled) << "column " << index;
        (agrees ? kept : dropped) += 1;
      }
    }
    EXPECT_GT(kept, 0);
    if (TypeParam::levels > 4) {
      EXPECT_GT(dropped, 0);
    }
  }
}

TYPED_TEST(confidence, uniqueness_compares_every_rival_with_the_winner) {
  raster_of_costs<TypeParam> raster;
  using check_t = uniqueness_check<TypeParam>;
  const auto check = std::make_unique<check_t>();
  level_group<TypeParam> group;
  int dropped = 0;
  std::vector<int> ratios;
  for (int beat = 0; beat < raster.beats() + check_t::delay_beats; ++beat) {
    ratios.push_back(raster.below(4) == 0 ? 0 : raster.below(32));
    ap_uint<16> lowest[check_t::lanes];
    for (int lane = 0; lane < check_t::lanes; ++lane) {
      const auto column = raster.at(beat, lane);
      lowest[lane] = column.costs[static_cast<std::size_t>(column.winner)];
    }
    const int then = beat - check_t::delay_beats;
    const auto step = [&] {
      const auto result =
          check->step(raster.costs(beat, group.index()), raster.found(beat), lowest, ratios.back(), group);
      for (int lane = 0; lane < check_t::lanes && then >= 0; ++lane) {
        for (int i = 0; i < check_t::levels; ++i) {
          EXPECT_EQ(result.costs.at[lane][i], raster.costs(then, group.index()).at[lane][i]);
        }
      }
      group.advance();
      return result;
    };
    auto result = step();
    while (!group.first()) result = step();
    if (then < 0) continue;
    expect_marks(result.found.marks, then);
    for (int lane = 0; lane < check_t::lanes; ++lane) {
      const auto column = raster.at(then, lane);
      const int m1 = column.costs[static_cast<std::size_t>(column.winner)];
      bool unique = true;
      for (int d = 0; d < TypeParam::levels; ++d) {
        const int cost = column.costs[static_cast<std::size_t>(d)];
        const bool rival = cost != 65535 && std::abs(d - column.winner) > 1;
        if (rival && 16 * cost < ratios[static_cast<std::size_t>(then)] * m1) unique = false;
      }
      ASSERT_EQ(result.found.pixel[lane].disparity, column.winner);
      ASSERT_EQ(result.found.pixel[lane].defined, column.in_frame && unique)
          << "beat " << then << ", ratio " << ratios[static_cast<std::size_t>(then)];
      dropped += column.in_frame && !unique;
    }
  }
  if (TypeParam::levels > 4) {
    EXPECT_GT(dropped, 0);
  }
}

}  // namespace
}  // namespace epiline::kernels
