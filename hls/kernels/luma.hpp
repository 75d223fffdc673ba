#pragma once
// The luma of video beats, and the rows of it that method 1's windows look at.
#include <ap_int.h>

#include "kernels/color.hpp"
#include "window/bits.hpp"
#include "window/line_buffer.hpp"

namespace epiline::kernels {

using luma_t = ap_uint<8>;

/// Y = (R + 2 G + B + 2) >> 2.
inline luma_t luma_of(const color& pixel) { return (pixel.red + pixel.green + pixel.green + pixel.blue + 2) >> 2; }

/// The left and right luma of a beat's columns in the newest `rows` rows: one RAM holds those of both images, already
/// reduced to 8 bits.
///
/// Border policy: columns outside the frame are 0, and so are rows below it (the caller passes beats of 0 there). Rows
/// above the frame hold what was left there before; whoever uses them has to know which rows are inside.
///
/// Config: pixels_per_beat, max_width.
template <class Config, int Rows>
class luma_rows {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int rows = Rows;
  using beat_t = ap_uint<lanes * color_bits>;

  /// [k][lane]: k rows above the newest one.
  struct columns {
    luma_t left[rows][lanes];
    luma_t right[rows][lanes];
  };

  /// `beat`: of the row; it may come again after `shortest_row` iterations at the earliest.
  columns step(const beat_t& left, const beat_t& right, int beat, bool in_columns) {
#pragma HLS INLINE
    word_t newest;
    for (int lane = 0; lane < lanes; ++lane) {
      newest.range(16 * lane + 7, 16 * lane) = luma_of(color_of_lane(left, lane));
      newest.range(16 * lane + 15, 16 * lane + 8) = luma_of(color_of_lane(right, lane));
    }
    word_t words[rows];
    for (int k = 0; k < rows; ++k) words[k] = 0;
    if (in_columns) {
      const auto above = lines_.step(newest, beat);
      words[0] = newest;
      for (int k = 1; k < rows; ++k) words[k] = above.rows[k - 1];
    }
    columns result;
    for (int k = 0; k < rows; ++k) {
      for (int lane = 0; lane < lanes; ++lane) {
        result.left[k][lane] = words[k].range(16 * lane + 7, 16 * lane);
        result.right[k][lane] = words[k].range(16 * lane + 15, 16 * lane + 8);
      }
    }
    return result;
  }

 private:
  using word_t = ap_uint<lanes * 16>;
  window::line_buffer<word_t, rows - 1, window::divide_up(Config::max_width, lanes)> lines_;
};

}  // namespace epiline::kernels
