#pragma once
#include <ap_int.h>

#include "kernels/color.hpp"
#include "kernels/column_place.hpp"
#include "kernels/level_array.hpp"
#include "kernels/level_groups.hpp"
#include "window/bits.hpp"
#include "window/line_buffer.hpp"

namespace epiline::kernels {

/// Vertical half of the SAD window: for every column x and level d
///   V(x, y, d) = V(x, y - 1, d) + AD(x, y, d) - AD(x, y - N, d)
/// where the sums of the row before wait in block RAM, one word a beat and group of levels: O(1) in the window's height
/// N.
///
/// Border policy: columns outside the frame are 0. Rows outside are 0 because the caller passes differences of 0 there.
/// State: the RAM. The first row of a frame does not use it, so it needs no clearing; a lane outside the frame's
/// columns keeps sums there that nobody sees, so that no gate stands in front of the RAM.
///
/// Config: levels, parallel_disparities, pixels_per_beat, max_width. Window: radius, largest_difference of two pixels.
template <class Config, class Window>
class column_sum {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int groups = level_groups<Config>::count;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  static constexpr int beats = window::divide_up(Config::max_width, lanes);
  using sum_t = ap_uint<window::bits_for((2 * Window::radius + 1) * Window::largest_difference)>;
  using differences = level_array<color_difference_t, lanes, levels>;
  using sums = level_array<sum_t, lanes, levels>;

  using place = column_place<lanes>;

  /// `entering` belongs to the row at the window's lower end, `leaving` to the row above its upper end.
  /// The same beat may come again after `shortest_row` iterations at the earliest.
  sums step(const differences& entering, const differences& leaving, const place& at,
            const level_group<Config>& group) {
#pragma HLS INLINE
#pragma HLS DEPENDENCE variable = sums_ type = inter distance = window::shortest_row true
    sums result;
    for (int lane = 0; lane < lanes; ++lane) {
      const int word = at.beat * groups + int(group.index());
      const bool lane_in = at.lane_in[lane];
      sum_t sum[levels];
      for (int d = 0; d < levels; ++d) sum[d] = 0;
      if (at.in_columns && !at.first_row) {
        for (int d = 0; d < levels; ++d) sum[d] = sums_[word][lane][d];
      }
      for (int d = 0; d < levels; ++d) {
        // One adder on the way from RAM to RAM; the net change is known long before.
        const ap_int<11> change = entering.at[lane][d] - leaving.at[lane][d];
        sum[d] = sum[d] + change;
        result.at[lane][d] = lane_in ? sum[d] : sum_t(0);
      }
      if (at.in_columns) {
        for (int d = 0; d < levels; ++d) sums_[word][lane][d] = sum[d];
      }
    }
    return result;
  }

 private:
  sum_t sums_[beats * groups][lanes][levels];
};

}  // namespace epiline::kernels
