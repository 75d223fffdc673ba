#pragma once
#include <ap_int.h>

#include "window/bits.hpp"

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

/// How row_delay keeps its rows in RAM.
enum class row_memory {
  /// All rows of a column in one wide word: for rows about as long as a block RAM is deep, or longer.
  side_by_side,
  /// One row behind the other in a narrow, deep RAM: for short rows, of which several share a block RAM.
  one_after_another,
};

/// What stood in a column `Rows` rows ago.
///
/// State: the rows, never reset, and where the newest one lies.
template <class Word, int Rows, int Columns, row_memory Memory>
class row_delay {
 public:
  /// Puts `newest` into column x (0 .. Columns - 1). The same column may come again after `shortest_row` iterations at
  /// the earliest. `row_starts`: the column is the first one of a row that has any.
  Word step(const Word& newest, int x, bool /*row_starts*/) { return rows_.step(newest, x).rows[Rows - 1]; }

 private:
  line_buffer<Word, Rows, Columns> rows_;
};

template <class Word, int Rows, int Columns>
class row_delay<Word, Rows, Columns, row_memory::one_after_another> {
 public:
  Word step(const Word& newest, int x, bool row_starts) {
#pragma HLS INLINE
#pragma HLS DEPENDENCE variable = words_ type = inter distance = shortest_row true
    if (row_starts) first_word_ = first_word_ == (Rows - 1) * Columns ? word_t(0) : word_t(first_word_ + Columns);
    const int word = int(first_word_) + x;
    const Word oldest = words_[word];
    words_[word] = newest;
    return oldest;
  }

 private:
  using word_t = ap_uint<bits_for(Rows* Columns)>;
  word_t first_word_;  // of the newest row
  Word words_[Rows * Columns];
};

}  // namespace epiline::window
