#pragma once

namespace epiline::kernels {

/// Where the columns of a beat lie, as sums over columns (column_sum, nested_column_sum) ask for it.
template <int Lanes>
struct column_place {
  int beat;             // of the row, may lie outside the frame
  bool in_columns;      // the beat lies in the columns of the frame
  bool lane_in[Lanes];  // the lane does, too: its sums are not 0
  bool first_row;       // of a frame

  /// The same place; with `restart` all its sums are 0, as row_sum wants a row of them.
  column_place cleared_if(bool restart) const {
    column_place result = *this;
    for (int lane = 0; lane < Lanes; ++lane) result.lane_in[lane] = lane_in[lane] && !restart;
    return result;
  }
};

}  // namespace epiline::kernels
