#pragma once
#include <ap_int.h>

#include <type_traits>

#include "kernels/level_groups.hpp"
#include "kernels/local_variation.hpp"
#include "kernels/luma.hpp"
#include "kernels/nested_column_sum.hpp"
#include "kernels/paired_row_sum.hpp"
#include "kernels/row_sum.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// Luma SAD over a 3x3, 5x5 or 7x7 window, chosen per pixel: C(x, y, d) = sum over the window around (x, y) of
/// |left(u, v) - right(max(u - d, 0), v)|, equation (2) of the paper. The three windows share their differences, and
/// since the choice does not depend on d, the three sums meet in front of the search for the winner.
///
/// Border policy: pixels outside the frame contribute 0. Costs of candidates d > x are meaningless, they must not win.
/// Lane l of the result belongs to the pixel `window_radius` rows above and `delay_columns` columns left of lane l of
/// the newest beat. Its levels are those of the iteration's group; all groups of a beat are given the same pixels.
///
/// Config: levels, parallel_disparities, pixels_per_beat, max_width.
template <class Config>
class adaptive_sad {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  static constexpr int window_radius = 3;
  static constexpr int window_rows = 2 * window_radius + 1;
  /// A beat more than the window needs: columns are summed up a beat after they were made, out of registers, and that
  /// those outside the frame are 0 is then a reset of these registers instead of a gate in front of every adder.
  static constexpr int delay_columns = window_radius + lanes;

 private:
  /// All three windows are centred on the same column, so the smaller ones wait for the largest.
  template <int Radius>
  struct luma_window {
    static constexpr int radius = Radius;
    static constexpr int largest_difference = 255;
    static constexpr int delay_columns = adaptive_sad::delay_columns;
    static constexpr int delay_beats = delay_columns;  // of one pixel
  };

 public:
  static constexpr int cost_bits = window::bits_for(window_rows * window_rows * 255);
  using cost_t = ap_uint<cost_bits + 1>;  // the bit on top is 0
  using costs = level_array<cost_t, lanes, levels>;
  static constexpr int penalty = 1 << cost_bits;  // for candidate_mask

  struct place {
    typename nested_column_sum<Config>::place column;
    bool row_starts;           // the first beat of a row
    bool row_in[window_rows];  // [k]: the row k above the newest one is not above the frame
    level_group<Config> group;
  };

  /// `left`, `right`: rows of the newest columns as of luma_rows; `choice[l]`: the window of the pixel lane l of the
  /// result belongs to.
  costs step(const luma_t (&left)[window_rows][lanes], const luma_t (&right)[window_rows][lanes], const place& at,
             const window_choice_t (&choice)[lanes]) {
#pragma HLS INLINE
    // Nobody looks at the sums of a frame's first row, for no window's centre is there: it sets the running sums right,
    // and no reset is needed.
    const bool restart = at.column.first_row;
    const auto columns = columns_.step(differences(0, left, right, at, row0_), differences(1, left, right, at, row1_),
                                       differences(5, left, right, at, row5_), differences(6, left, right, at, row6_),
                                       at.column.cleared_if(restart), at.group);
    const auto three = rows3_.step(columns.three, restart);
    const auto five = rows5_.step(columns.five, restart);
    const auto seven = rows7_.step(columns.seven, restart);
    costs result;
    if constexpr (lanes == 1) {
      choose(result, choice, three, five, seven);
    } else {
      level_array<ap_uint<cost_bits>, lanes, levels> single;
      choose(result, choice, three.pairs, five.pairs, seven.pairs);
      choose(single, choice, three.single, five.single, seven.single);
      for (int lane = 0; lane < lanes; ++lane) {
        for (int d = 0; d < levels; ++d) result.at[lane][d] = result.at[lane][d] + single.at[lane][d];
      }
    }
    return result;
  }

 private:
  // The newest right pixels of a row. A column right of the window's centre reaches `window_radius` pixels further left
  // than the centre's candidates do.
  using taps = window::row_window<luma_t, lanes, lanes - 1 + levels, window::replicated_border<window_radius>,
                                  level_groups<Config>::count>;
  using rows_t = luma_t[window_rows][lanes];

  /// One pixel a beat: a running sum takes the fewest adders. More: pairs do.
  template <int Radius>
  using rows_of =
      std::conditional_t<lanes == 1, row_sum<Config, luma_window<Radius>>, paired_row_sum<Config, luma_window<Radius>>>;

  /// The values of every lane's own window.
  template <class Result, class Three, class Five, class Seven>
  static void choose(Result& result, const window_choice_t (&choice)[lanes], const Three& three, const Five& five,
                     const Seven& seven) {
#pragma HLS INLINE
    for (int lane = 0; lane < lanes; ++lane) {
      for (int d = 0; d < levels; ++d) result.at[lane][d] = seven.at[lane][d];
      if (choice[lane] == window_5x5) {
        for (int d = 0; d < levels; ++d) result.at[lane][d] = five.at[lane][d];
      }
      if (choice[lane] == window_3x3) {
        for (int d = 0; d < levels; ++d) result.at[lane][d] = three.at[lane][d];
      }
    }
  }

  static typename nested_column_sum<Config>::differences differences(int k, const rows_t& left, const rows_t& right,
                                                                     const place& at, taps& history) {
#pragma HLS INLINE
    luma_t left_pixels[lanes];
    luma_t right_pixels[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      left_pixels[lane] = at.row_in[k] ? left[k][lane] : luma_t(0);
      right_pixels[lane] = at.row_in[k] ? right[k][lane] : luma_t(0);
    }
    history.step(right_pixels, at.row_starts, at.group.index());
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
  rows_of<1> rows3_;
  rows_of<2> rows5_;
  rows_of<3> rows7_;
};

}  // namespace epiline::kernels
