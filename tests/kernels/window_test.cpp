#include "window/window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "window/bits.hpp"
#include "window/delay_line.hpp"
#include "window/line_buffer.hpp"
#include "window/raster.hpp"
#include "window/reduce.hpp"

namespace epiline::window {
namespace {

static_assert(bits_for(0) == 1 && bits_for(1) == 1 && bits_for(2) == 2 && bits_for(255) == 8 && bits_for(256) == 9);
static_assert(divide_up(0, 4) == 0 && divide_up(1, 4) == 1 && divide_up(4, 4) == 1 && divide_up(5, 4) == 2);

TEST(line_buffer, returns_the_rows_above_of_the_same_column) {
  constexpr int columns = 9;
  constexpr int rows = 3;
  line_buffer<ap_uint<16>, rows, columns> lines{};
  std::mt19937 random(1);
  std::map<std::pair<int, int>, int> written;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int value = static_cast<int>(random() % 65536);
      const auto above = lines.step(value, x);
      written[{x, y}] = value;
      for (int k = 0; k < rows && k < y; ++k) EXPECT_EQ(above.rows[k], (written[{x, y - 1 - k}])) << x << ' ' << y;
    }
  }
}

/// Rows of changing length, as frames of different width have them.
template <row_memory Memory>
void expect_row_delay() {
  constexpr int columns = 11;
  constexpr int rows = 3;
  row_delay<ap_uint<16>, rows, columns, Memory> delay{};
  std::mt19937 random(2);
  for (const int length : {columns, 8, 9}) {
    std::map<std::pair<int, int>, int> written;
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < length; ++x) {
        const int value = static_cast<int>(random() % 65536);
        const auto oldest = delay.step(value, x, x == 0);
        written[{x, y}] = value;
        if (y >= rows) {
          EXPECT_EQ(oldest, (written[{x, y - rows}])) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(row_delay, returns_the_word_some_rows_above) {
  expect_row_delay<row_memory::side_by_side>();
  expect_row_delay<row_memory::one_after_another>();
}

/// Rows of 8 pixels numbered on from row to row; expected(tap's column, row) is the pixel number there.
template <int Lanes, class Border, class Expected>
void expect_row_window(Expected expected) {
  constexpr int row_pixels = 8;
  constexpr int length = Lanes + 5;
  row_window<int, Lanes, length, Border> row{};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < row_pixels; x += Lanes) {
      int beat[Lanes];
      for (int lane = 0; lane < Lanes; ++lane) beat[lane] = 1 + y * row_pixels + x + lane;
      row.step(beat, x == 0);
      for (int i = 0; i < length; ++i) {
        const int column = x + Lanes - 1 - i;
        EXPECT_EQ(row.tap[i], expected(column, y))
            << "lanes " << Lanes << ", row " << y << ", x " << x << ", tap " << i;
      }
    }
  }
}

TEST(row_window, holds_the_end_of_the_row_before) {
  const auto pixel = [](int column, int y) { return std::max(1 + y * 8 + column, 0); };
  expect_row_window<1, previous_row_border>(pixel);
  expect_row_window<2, previous_row_border>(pixel);
  expect_row_window<4, previous_row_border>(pixel);
}

TEST(row_window, replicates_the_first_pixel_of_the_row) {
  // All columns that a window of this length can reach are within the border.
  const auto pixel = [](int column, int y) { return 1 + y * 8 + std::max(column, 0); };
  expect_row_window<1, replicated_border<5>>(pixel);
  expect_row_window<2, replicated_border<5>>(pixel);
  expect_row_window<4, replicated_border<9>>(pixel);
}

/// A window in parts shows, part by part, what one as long as all of them shows at once.
template <int Length, int Parts, class Border>
void expect_parts() {
  row_window<int, 1, Length * Parts, Border> whole{};
  row_window<int, 1, Length, Border, Parts> in_parts{};
  for (int step = 0; step < 60; ++step) {
    const int beat[1] = {1 + step};
    const bool row_starts = step % 7 == 0;
    whole.step(beat, row_starts);
    for (int part = 0; part < Parts; ++part) {
      in_parts.step(beat, row_starts, part);
      for (int i = 0; i < Length; ++i) {
        EXPECT_EQ(in_parts.tap[i], whole.tap[part * Length + i])
            << "step " << step << ", part " << part << ", tap " << i;
      }
    }
  }
}

TEST(row_window, shows_its_parts_one_after_another) {
  expect_parts<4, 3, previous_row_border>();
  expect_parts<4, 2, replicated_border<3>>();
  expect_parts<2, 5, replicated_border<3>>();  // the border reaches into the second part
  expect_parts<1, 5, replicated_border<3>>();
}

template <int Length>
void expect_delay() {
  delay_line<ap_uint<8>, Length> delay{};
  for (int i = 0; i < 5 * Length + 3; ++i) {
    const int expected = i < Length ? 0 : (i - Length) % 251 + 1;
    EXPECT_EQ(delay.step(i % 251 + 1), expected) << "length " << Length << ", step " << i;
  }
}

TEST(delay_line, delays_by_its_length) {
  expect_delay<1>();
  expect_delay<2>();
  expect_delay<7>();
  expect_delay<32>();
  expect_delay<87>();
}

struct schedule {
  static constexpr int maximum_beats = 20;
  static constexpr int maximum_rows = 9;
  static constexpr int padding_beats = 3;
  static constexpr int padding_rows = 3;
  static constexpr int flush_beats = 30;
  static constexpr int minimum_row_beats = 8;
};

TEST(raster, visits_every_beat_once_and_in_order) {
  for (int beats = 1; beats <= schedule::maximum_beats; ++beats) {
    for (int rows = 1; rows <= schedule::maximum_rows; ++rows) {
      raster<schedule> walk(beats, rows);
      const int row_beats = std::max(beats + schedule::padding_beats, schedule::minimum_row_beats);
      for (int row = 0; row < rows + schedule::padding_rows; ++row) {
        for (int beat = 0; beat < row_beats; ++beat) {
          ASSERT_EQ(walk.row(), row);
          ASSERT_EQ(walk.beat(), beat);
          ASSERT_EQ(walk.in_columns(), beat < beats);
          ASSERT_EQ(walk.in_frame(), beat < beats && row < rows);
          ASSERT_FALSE(walk.in_flush());
          ASSERT_TRUE(walk.advance());
        }
      }
      for (int beat = 0; beat < schedule::flush_beats; ++beat) {
        ASSERT_TRUE(walk.in_flush());
        ASSERT_FALSE(walk.in_frame());
        ASSERT_EQ(walk.advance(), beat != schedule::flush_beats - 1);
      }
    }
  }
}

template <int N>
void expect_sum_of_all() {
  int values[N];
  int sum = 0;
  for (int i = 0; i < N; ++i) sum += values[i] = 1 << (i % 20);
  EXPECT_EQ(reduce(values, [](int a, int b) { return a + b; }), sum) << N;
}

TEST(reduce, combines_every_value_once) {
  expect_sum_of_all<1>();
  expect_sum_of_all<2>();
  expect_sum_of_all<3>();
  expect_sum_of_all<8>();
  expect_sum_of_all<13>();
  expect_sum_of_all<80>();
  expect_sum_of_all<128>();
}

/// How many combinations lie on the deepest path.
template <int N>
int depth_of_tree() {
  int depths[N] = {};
  return reduce(depths, [](int a, int b) { return std::max(a, b) + 1; });
}

TEST(reduce, is_a_balanced_tree) {
  EXPECT_EQ(depth_of_tree<1>(), 0);
  EXPECT_EQ(depth_of_tree<2>(), 1);
  EXPECT_EQ(depth_of_tree<5>(), 3);
  EXPECT_EQ(depth_of_tree<80>(), 7);
  EXPECT_EQ(depth_of_tree<128>(), 7);
}

/// Small values make ties of every kind.
template <int N>
void expect_minimum_with_ties() {
  std::mt19937 random(N);
  for (int trial = 0; trial < 300; ++trial) {
    const unsigned range = trial % 2 == 0 ? 3 : 65536;
    ap_uint<16> values[N];
    std::vector<int> plain;
    for (auto& value : values) {
      value = random() % range;
      if (trial == 7) value = 65535;
      plain.push_back(value.to_int());
    }
    const auto first = std::min_element(plain.begin(), plain.end());
    const auto last = std::min_element(plain.rbegin(), plain.rend());
    const auto smallest = minimum<smallest_index_wins>(values);
    EXPECT_EQ(smallest.value, *first);
    EXPECT_EQ(smallest.index, first - plain.begin());
    const auto largest = minimum<largest_index_wins>(values);
    EXPECT_EQ(largest.value, *first);
    EXPECT_EQ(largest.index, N - 1 - (last - plain.rbegin()));
  }
}

TEST(minimum, ties_go_to_the_index_its_policy_names) {
  expect_minimum_with_ties<1>();
  expect_minimum_with_ties<2>();
  expect_minimum_with_ties<3>();
  expect_minimum_with_ties<7>();
  expect_minimum_with_ties<8>();
  expect_minimum_with_ties<60>();
  expect_minimum_with_ties<80>();
  expect_minimum_with_ties<128>();
}

}  // namespace
}  // namespace epiline::window
