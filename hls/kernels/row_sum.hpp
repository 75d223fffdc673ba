#pragma once
#include <ap_int.h>

#include "kernels/level_array.hpp"
#include "kernels/level_delay.hpp"
#include "kernels/level_groups.hpp"
#include "window/bits.hpp"

namespace epiline::kernels {

/// Horizontal half of the SAD window: C(x, d) = sum of V(x + k, d), k = -r .. r, as a running sum
///   C(x, d) = C(x - 1, d) + V(x + r, d) - V(x - r - 1, d).
/// The change over all lanes of a beat is summed up first, so the running sum's own loop holds one adder whatever the
/// number of lanes.
///
/// Lane l of the result belongs to column l of the beat `delay_beats` before the newest one.
/// Border policy: outside columns are 0, which the caller provides by at least r columns of 0 between two rows.
/// State: the columns that are still inside the window or wait to leave it, and the running sum. Invariant: the sum
/// equals the sum of its columns. It holds at zero and no step breaks it, so nothing is to be reset between rows or
/// frames; an object must start zeroed (static, or T{}), or with a row of `restart`. With several groups of levels the
/// columns wait so long that RAM may take them (level_delay).
///
/// Config: levels, parallel_disparities, pixels_per_beat. Window: radius, largest_difference of two pixels, delay_beats
/// (at least the beats of the radius; more of them line the result up with that of a wider window).
template <class Config, class Window>
class row_sum {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int groups = level_groups<Config>::count;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  static constexpr int window_columns = 2 * Window::radius + 1;
  static constexpr int delay_beats = Window::delay_beats;
  static_assert(delay_beats * lanes >= Window::radius, "the window reaches further right than the newest column");

  using column_t = ap_uint<window::bits_for(window_columns* Window::largest_difference)>;
  using column_beat = level_array<column_t, lanes, levels>;
  using cost_t = ap_uint<window::bits_for(window_columns* window_columns* Window::largest_difference)>;
  using costs = level_array<cost_t, lanes, levels>;

  /// `restart` during a whole row of columns of 0 makes the state agree with itself, whatever it was: what that row
  /// leaves in the window is 0, and so is the sum.
  costs step(const column_beat& newest, bool restart) {
#pragma HLS INLINE
    if constexpr (groups > 1) {  // one lane
      entering_ = waiting_.step(newest);
      leaving_ = inside_.step(newest);
    }
    costs result;
    change_t change[levels];
    for (int d = 0; d < levels; ++d) change[d] = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const column_t(&entering)[levels] = column(newest, lane - skew);
      const column_t(&leaving)[levels] = column(newest, lane - skew - window_columns);
      for (int d = 0; d < levels; ++d) {
        change[d] = change[d] + (entering[d] - leaving[d]);
        result.at[lane][d] = sum_[groups - 1][d] + change[d];
      }
    }
    move_groups_on(sum_);
    for (int d = 0; d < levels; ++d) sum_[0][d] = restart ? cost_t(0) : result.at[lanes - 1][d];

    if constexpr (groups == 1) {
      for (int k = history - 1; k >= lanes; --k) {
        for (int d = 0; d < levels; ++d) columns_[k][d] = columns_[k - lanes][d];
      }
      for (int lane = 0; lane < lanes; ++lane) {
        for (int d = 0; d < levels; ++d) columns_[lanes - 1 - lane][d] = newest.at[lane][d];
      }
    }
    return result;
  }

 private:
  /// How many columns the window's right end lies behind the lane, so that results come out in whole beats.
  static constexpr int skew = delay_beats * lanes - Window::radius;
  static constexpr int history = window::larger(skew + window_columns, lanes);
  using change_t = ap_int<16>;  // modulo 2^16, as the sum

  /// Column i of the newest beat; negative: before it.
  const column_t (&column(const column_beat& newest, int i) const)[levels] {
    if constexpr (groups > 1) return i == -skew ? entering_.at[0] : leaving_.at[0];
    return i >= 0 ? newest.at[i] : columns_[-1 - i];
  }

  cost_t sum_[groups][levels];
  // One group: the columns, [0] = the last one before the newest beat.
  column_t columns_[history][levels];
  // Several groups: the columns that wait to enter the window, and those that wait to leave it.
  level_delay<column_t, levels, groups == 1 ? 0 : skew * groups> waiting_;
  level_delay<column_t, levels, groups == 1 ? 0 : (skew + window_columns) * groups> inside_;
  column_beat entering_;
  column_beat leaving_;
};

}  // namespace epiline::kernels
