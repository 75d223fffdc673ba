#pragma once

namespace epiline::window {

/// Fewest iterations between two visits of the same column: what RAMs addressed by the column promise to the pipeline,
/// and what whoever walks over the raster has to keep, however narrow the frame.
inline constexpr int shortest_row = 8;

/// The last `Rows` words of every column of a raster: one RAM whose word holds all rows of a column side by side, so
/// that one read and one write an iteration move the whole column down by a row.
///
/// State: the RAM, never reset; what `step` returns for rows not yet written since power-up is meaningless.
template <class Word, int Rows, int Columns>
class line_buffer {
 public:
  /// rows[0] = the word one row above, rows[Rows - 1] = the oldest one.
  struct column {
    Word rows[Rows];
  };

  /// Puts `newest` into column x (0 .. Columns - 1) and returns what stood there before.
  /// The same column may come again after `shortest_row` iterations at the earliest.
  column step(const Word& newest, int x) {
#pragma HLS INLINE
#pragma HLS DEPENDENCE variable = lines_ type = inter distance = shortest_row true
    column above;
    for (int row = 0; row < Rows; ++row) above.rows[row] = lines_[x][row];
    for (int row = Rows - 1; row > 0; --row) lines_[x][row] = above.rows[row - 1];
    lines_[x][0] = newest;
    return above;
  }

 private:
  Word lines_[Columns][Rows];
};

}  // namespace epiline::window
