#pragma once
#include <ap_int.h>

#include "kernels/level_array.hpp"
#include "window/bits.hpp"

namespace epiline::kernels {

/// Horizontal half of a SAD window at several pixels a beat, C(x, d) = sum of V(x + k, d), k = -r .. r, without a
/// running sum: an odd number of columns is r pairs of neighbours and a single one at the window's left or right end.
/// Pairs begin at even columns, so two pixels beside each other share theirs, and a pair's sum serves every window that
/// holds it: r + 2 adders for two pixels and no feedback. The two parts come out apart; who chooses among windows adds
/// but once.
///
/// Lane l of the result belongs to the pixel `Window::delay_columns` columns left of column l of the newest beat.
/// Border policy: outside columns are 0, which the caller provides by at least r columns of 0 between two rows.
/// State: the columns and pairs that are still inside the window. Nothing is to be reset between rows or frames.
///
/// Config: levels, pixels_per_beat (even). Window: radius, largest_difference of two pixels, delay_columns (at least
/// the radius; more of them line the result up with that of a wider window).
template <class Config, class Window>
class paired_row_sum {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int levels = Config::levels;
  static constexpr int radius = Window::radius;
  static constexpr int window_columns = 2 * radius + 1;
  static_assert(lanes % 2 == 0, "pairs are of one beat");

  using column_t = ap_uint<window::bits_for(window_columns* Window::largest_difference)>;
  using column_beat = level_array<column_t, lanes, levels>;
  using pair_t = ap_uint<window::bits_for(2 * window_columns * Window::largest_difference)>;
  using pairs_t = ap_uint<window::bits_for(2 * radius * window_columns * Window::largest_difference)>;

  struct result {
    level_array<pairs_t, lanes, levels> pairs;
    level_array<column_t, lanes, levels> single;
  };

  /// `restart`: as row_sum takes it; here is nothing to set right.
  result step(const column_beat& newest, bool /*restart*/) {
#pragma HLS INLINE
    pairs_t pairs[new_pairs][levels];  // the r pairs that end with pair `pair` of the beat
    for (int pair = 0; pair < new_pairs; ++pair) {
      const column_t(&left)[levels] = column(newest, 2 * pair - lag);
      const column_t(&right)[levels] = column(newest, 2 * pair + 1 - lag);
      pair_t sum[levels];
      for (int d = 0; d < levels; ++d) sum[d] = left[d] + right[d];
      for (int d = 0; d < levels; ++d) pairs[pair][d] = sum[d];
      for (int before = 0; before < radius - 1; ++before) {
        for (int d = 0; d < levels; ++d) pairs[pair][d] = pairs[pair][d] + pair_[before][d];
      }
      for (int before = radius - 1; before > 0; --before) {
        for (int d = 0; d < levels; ++d) pair_[before][d] = pair_[before - 1][d];
      }
      for (int d = 0; d < levels; ++d) pair_[0][d] = sum[d];
    }

    result found;
    for (int lane = 0; lane < lanes; ++lane) {
      const int first = lane - Window::delay_columns - radius;  // of the window, counted from the newest beat's first
      const bool pairs_first = is_even(first);
      const column_t(&single)[levels] = column(newest, pairs_first ? first + 2 * radius : first);
      for (int d = 0; d < levels; ++d) found.single.at[lane][d] = single[d];
      // How many pairs ago the window's last one entered: 0 = the newest.
      const int age = (lanes - lag - (pairs_first ? first : first + 1)) / 2 - radius;
      for (int d = 0; d < levels; ++d) {
        found.pairs.at[lane][d] = age < new_pairs ? pairs[new_pairs - 1 - age][d] : pairs_[age - new_pairs][d];
      }
    }

    for (int k = pairs_kept - 1; k >= 0; --k) {
      for (int d = 0; d < levels; ++d) {
        pairs_[k][d] = k < new_pairs ? pairs[new_pairs - 1 - k][d] : pairs_[k - new_pairs][d];
      }
    }
    for (int k = columns_kept - 1; k >= 0; --k) {
      for (int d = 0; d < levels; ++d) {
        columns_[k][d] = k < lanes ? newest.at[lanes - 1 - k][d] : columns_[k - lanes][d];
      }
    }
    return found;
  }

 private:
  static constexpr bool is_even(int column) { return column % 2 == 0; }
  static constexpr int new_pairs = lanes / 2;
  /// A window that does not reach the newest beats takes its pairs from a later one: columns are narrower than pairs.
  static constexpr int lag = (Window::delay_columns - radius) / lanes * lanes;
  static constexpr int columns_kept = Window::delay_columns + radius;
  static constexpr int pairs_kept = window::divide_up(columns_kept - lag, 2);

  /// Column i of the newest beat; negative: before it.
  const column_t (&column(const column_beat& newest, int i) const)[levels] {
    return i >= 0 ? newest.at[i] : columns_[-1 - i];
  }

  column_t columns_[columns_kept][levels];  // [0] = the last column before the newest beat
  pair_t pair_[radius][levels];             // [0] = the last pair before that of the loop
  pairs_t pairs_[pairs_kept][levels];       // [0] = the pairs that end with the last one before the newest beat
};

}  // namespace epiline::kernels
