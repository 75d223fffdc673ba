#pragma once
#include <ap_int.h>

#include "kernels/color.hpp"
#include "kernels/column_sum.hpp"
#include "kernels/level_groups.hpp"
#include "kernels/row_sum.hpp"
#include "window/line_buffer.hpp"

namespace epiline::kernels {

/// The window of a colour SAD, as its sums take it. A beat more than the window needs: columns are summed up a beat
/// after they were made, out of registers, and that those outside the frame are 0 is then a reset of these registers
/// instead of a gate in front of every adder. Config: pixels_per_beat, window_radius.
template <class Config>
struct color_window {
  static constexpr int radius = Config::window_radius;
  static constexpr int largest_difference = 765;
  static constexpr int delay_beats = window::divide_up(radius, Config::pixels_per_beat) + 1;
};

/// Colour SAD over a square window: C(x, y, d) = sum over the N x N pixels around (x, y) of |dR| + |dG| + |dB| between
/// left pixel x and right pixel max(x - d, 0). Two differences a level and lane (the row that enters the window, the
/// row that leaves it) and four adders, whatever N.
///
/// Border policy: pixels outside the frame contribute 0. Costs of candidates d > x are meaningless, they must not win.
/// Lane l of the result belongs to the pixel `window_radius` rows above and `delay_beats` beats before the newest one.
/// Its levels are those of the iteration's group; the beat's pixels wait for the further groups.
///
/// Config: levels, parallel_disparities, pixels_per_beat, max_width, window_radius, row_memory.
template <class Config>
class color_sad {
  using columns = column_sum<Config, color_window<Config>>;
  using rows = row_sum<Config, color_window<Config>>;

 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  static constexpr int window_rows = 2 * Config::window_radius + 1;
  static constexpr int delay_beats = rows::delay_beats;
  using beat_t = ap_uint<lanes * color_bits>;
  using cost_t = typename rows::cost_t;
  using costs = typename rows::costs;
  static constexpr int penalty = (1 << cost_t::width) - 1;  // for candidate_mask: there is no spare bit

  /// Nobody looks at the sums of a frame's first row, for no window ends there, unless windows have but one row: so
  /// that row sets the state right, and no reset is needed.
  static constexpr bool restarts = window_rows > 1;

  struct place {
    typename columns::place column;
    bool row_starts;     // the first beat of a row
    bool row_can_leave;  // a row of this frame leaves the window: at least window_rows rows came before
    level_group<Config> group;
  };

  /// `left`, `right`: the newest beats, 0 in rows below the frame; looked at in the first group only.
  costs step(const beat_t& left, const beat_t& right, const place& at) {
#pragma HLS INLINE
    if (at.group.first()) {
      pixels_ = {left, right, 0, 0};
      if (at.column.in_columns) {
        const beat_pair above = rows_above_.step({left, right}, at.column.beat, at.row_starts);
        if (at.row_can_leave) {
          pixels_.oldest_left = above.left;
          pixels_.oldest_right = above.right;
        }
      }
    }
    const auto entering = differences(pixels_.left, pixels_.right, entering_right_, at);
    const auto leaving = differences(pixels_.oldest_left, pixels_.oldest_right, leaving_right_, at);
    const bool restart = restarts && at.column.first_row;
    return rows_.step(columns_.step(entering, leaving, at.column.cleared_if(restart), at.group), restart);
  }

 private:
  static constexpr int max_beats = window::divide_up(Config::max_width, lanes);
  // A column right of the window's centre reaches `window_radius` pixels further left than the centre's candidates do.
  using taps = pixel_taps<lanes, lanes - 1 + levels, Config::window_radius, level_groups<Config>::count>;

  struct beat_pixels {
    beat_t left;
    beat_t right;
    beat_t oldest_left;
    beat_t oldest_right;
  };

  static typename columns::differences differences(const beat_t& left, const beat_t& right, taps& history,
                                                   const place& at) {
    color left_pixels[lanes];
    color right_pixels[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      left_pixels[lane] = color_of_lane(left, lane);
      right_pixels[lane] = color_of_lane(right, lane);
    }
    history.step(right_pixels, at.row_starts, at.group.index());
    typename columns::differences result;
    for (int lane = 0; lane < lanes; ++lane) {
      const color pixel = left_pixels[lane];
      for (int d = 0; d < levels; ++d) {
        const int tap = lanes - 1 - lane + d;
        result.at[lane][d] = absolute_difference(pixel.red, history.red.tap[tap]) +
                             absolute_difference(pixel.green, history.green.tap[tap]) +
                             absolute_difference(pixel.blue, history.blue.tap[tap]);
      }
    }
    return result;
  }

  struct beat_pair {
    beat_t left;
    beat_t right;
  };
  window::row_delay<beat_pair, window_rows, max_beats, Config::row_memory> rows_above_;
  beat_pixels pixels_;
  taps entering_right_;
  taps leaving_right_;
  columns columns_;
  rows rows_;
};

}  // namespace epiline::kernels
