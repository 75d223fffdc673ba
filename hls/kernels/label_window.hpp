#pragma once
#include <ap_int.h>

#include "window/bits.hpp"
#include "window/line_buffer.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// A pixel's label: its disparity, and bit 7 = defined. An undefined label is 0.
using label_t = ap_uint<8>;

/// The square of labels around a centre that walks over the raster, `Radius` rows above and `delay_beats` beats before
/// the newest label. Rows above come from line buffers, columns from registers.
///
/// Border policy: cells outside the frame are undefined. The caller provides `Radius` rows of undefined labels before
/// and after the frame, and between two rows at least `Radius` labels outside the columns, which are taken as
/// undefined.
///
/// Config: pixels_per_beat, max_width.
template <class Config, int Radius>
class label_window {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int rows = 2 * Radius + 1;
  static constexpr int delay_beats = window::divide_up(Radius, lanes);

  /// `beat`: of the row; it may come again after `shortest_row` iterations at the earliest.
  void step(const label_t (&newest)[lanes], int beat, bool in_columns) {
#pragma HLS INLINE
    label_t labels[rows][lanes];
    for (int row = 0; row < rows; ++row) {
      for (int lane = 0; lane < lanes; ++lane) labels[row][lane] = 0;
    }
    if (in_columns) {
      word_t word;
      for (int lane = 0; lane < lanes; ++lane) word.range(8 * lane + 7, 8 * lane) = newest[lane];
      const auto above = lines_.step(word, beat);
      for (int lane = 0; lane < lanes; ++lane) {
        labels[rows - 1][lane] = newest[lane];
        for (int row = 0; row < rows - 1; ++row) {
          labels[row][lane] = above.rows[rows - 2 - row].range(8 * lane + 7, 8 * lane);
        }
      }
    }
    for (int row = 0; row < rows; ++row) rows_[row].step(labels[row], false);
  }

  /// The cell `down` rows below and `right` columns right of the lane's centre.
  label_t cell(int lane, int down, int right) const {
    return rows_[Radius + down].tap[delay_beats * lanes + lanes - 1 - lane - right];
  }

 private:
  using word_t = ap_uint<lanes * 8>;
  window::line_buffer<word_t, rows - 1, window::divide_up(Config::max_width, lanes)> lines_;
  window::row_window<label_t, lanes, delay_beats * lanes + lanes + Radius> rows_[rows];
};

}  // namespace epiline::kernels
