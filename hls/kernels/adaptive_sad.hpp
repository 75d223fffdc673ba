#pragma once
#include <ap_int.h>

#include "kernels/local_variation.hpp"
#include "kernels/luma.hpp"
#include "kernels/nested_column_sum.hpp"
#include "kernels/row_sum.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// Luma SAD over a 3x3, 5x5 or 7x7 window, chosen per pixel: C(x, y, d) = sum over the window around (x, y) of
/// |left(u, v) - right(max(u - d, 0), v)|, equation (2) of the paper. The three windows share their differences, and
/// since the choice does not depend on d, the three sums meet in front of the search for the winner.
///
/// Border policy: pixels outside the frame contribute 0. Costs of candidates d > x are meaningless, they must not win.
/// Lane l of the result belongs to the pixel `window_radius` rows above and `delay_beats` beats before the newest one.
///
/// Config: levels, pixels_per_beat, max_width.
template <class Config>
class adaptive_sad {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int levels = Config::levels;
  static constexpr int window_radius = 3;
  static constexpr int window_rows = 2 * window_radius + 1;
  static constexpr int delay_beats = window::divide_up(window_radius, lanes);

 private:
  /// All three windows are centred on the same column, so the smaller ones wait for the largest.
  template <int Radius>
  struct luma_window {
    static constexpr int radius = Radius;
    static constexpr int largest_difference = 255;
    static constexpr int delay_beats = adaptive_sad::delay_beats;
  };

 public:
  static constexpr int cost_bits = row_sum<Config, luma_window<3>>::cost_t::width;
  using cost_t = ap_uint<cost_bits + 1>;  // the bit on top is 0
  using costs = level_array<cost_t, lanes, levels>;
  static constexpr int penalty = 1 << cost_bits;  // for candidate_mask

  struct place {
    typename nested_column_sum<Config>::place column;
    bool row_starts;           // the first beat of a row
    bool row_in[window_rows];  // [k]: the row k above the newest one is not above the frame
  };

  /// `left`, `right`: rows of the newest columns as of luma_rows; `choice[l]`: the window of the pixel lane l of the
  /// result belongs to.
  costs step(const luma_t (&left)[window_rows][lanes], const luma_t (&right)[window_rows][lanes], const place& at,
             const window_choice_t (&choice)[lanes]) {
#pragma HLS INLINE
    const auto columns =
        columns_.step(differences(0, left, right, at, row0_), differences(1, left, right, at, row1_),
                      differences(5, left, right, at, row5_), differences(6, left, right, at, row6_), at.column);
    const auto cost3 = rows3_.step(columns.three);
    const auto cost5 = rows5_.step(columns.five);
    const auto cost7 = rows7_.step(columns.seven);
    costs result;
    for (int lane = 0; lane < lanes; ++lane) {
      for (int d = 0; d < levels; ++d) result.at[lane][d] = cost7.at[lane][d];
      if (choice[lane] == window_5x5) {
        for (int d = 0; d < levels; ++d) result.at[lane][d] = cost5.at[lane][d];
      }
      if (choice[lane] == window_3x3) {
        for (int d = 0; d < levels; ++d) result.at[lane][d] = cost3.at[lane][d];
      }
    }
    return result;
  }

 private:
  // The newest right pixels of a row. A column right of the window's centre reaches `window_radius` pixels further left
  // than the centre's candidates do.
  using taps = window::row_window<luma_t, lanes, lanes - 1 + levels, window::replicated_border<window_radius>>;
  using rows_t = luma_t[window_rows][lanes];

  static typename nested_column_sum<Config>::differences differences(int k, const rows_t& left, const rows_t& right,
                                                                     const place& at, taps& history) {
#pragma HLS INLINE
    luma_t left_pixels[lanes];
    luma_t right_pixels[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      left_pixels[lane] = at.row_in[k] ? left[k][lane] : luma_t(0);
      right_pixels[lane] = at.row_in[k] ? right[k][lane] : luma_t(0);
    }
    history.step(right_pixels, at.row_starts);
    typename nested_column_sum<Config>::differences result;
    for (int lane = 0; lane < lanes; ++lane) {
      for (int d = 0; d < levels; ++d) {
        result.at[lane][d] = absolute_difference(left_pixels[lane], history.tap[lanes - 1 - lane + d]);
      }
    }
    return result;
  }

  taps row0_;  // k rows above the newest one
  taps row1_;
  taps row5_;
  taps row6_;
  nested_column_sum<Config> columns_;
  row_sum<Config, luma_window<1>> rows3_;
  row_sum<Config, luma_window<2>> rows5_;
  row_sum<Config, luma_window<3>> rows7_;
};

}  // namespace epiline::kernels
