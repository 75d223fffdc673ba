#pragma once
#include <ap_int.h>

#include "window/bits.hpp"

namespace epiline::window {

/// Walks over a frame, one beat an iteration: `rows` rows of real beats, then Schedule::padding_rows more, each row
/// followed by Schedule::padding_beats beats outside the frame; at last Schedule::flush_beats iterations that let the
/// kernels' delays run out. One flat counter pair instead of two nested loops: the only feedback is "equal, then 0 else
/// plus 1". A row has at least Schedule::minimum_row_beats iterations, so a RAM addressed by the beat meets the same
/// address again after that many iterations at the earliest, whatever the width.
///
/// Schedule: named constants maximum_beats, maximum_rows, padding_beats, padding_rows, flush_beats, minimum_row_beats.
template <class Schedule>
class raster {
 public:
  static constexpr int longest_row = larger(
      larger(Schedule::maximum_beats + Schedule::padding_beats, Schedule::minimum_row_beats), Schedule::flush_beats);
  using beats_t = ap_uint<bits_for(Schedule::maximum_beats)>;
  using rows_t = ap_uint<bits_for(Schedule::maximum_rows)>;
  using beat_t = ap_uint<bits_for(longest_row)>;
  using row_t = ap_uint<bits_for(Schedule::maximum_rows + Schedule::padding_rows + 1)>;

  /// Begins a frame of `beats` x `rows` (both at least 1).
  raster(beats_t beats, rows_t rows) : beat_(0), row_(0), beats_(beats), rows_(rows) {
    const beat_t wanted = beats + Schedule::padding_beats - 1;
    last_beat_ = wanted < Schedule::minimum_row_beats - 1 ? beat_t(Schedule::minimum_row_beats - 1) : wanted;
    last_padding_row_ = rows + Schedule::padding_rows - 1;
    flush_row_ = rows + Schedule::padding_rows;
  }

  beat_t beat() const { return beat_; }
  row_t row() const { return row_; }
  /// The beat lies in the columns of the frame.
  bool in_columns() const { return beat_ < beats_; }
  /// The beat is one of the frame.
  bool in_frame() const { return row_ < rows_ && in_columns(); }
  bool in_flush() const { return row_ == flush_row_; }

  /// Goes on to the next iteration; false after the last one.
  bool advance() {
    const bool row_ends = beat_ == last_beat_;
    const bool more = !(row_ends && row_ == flush_row_);
    if (row_ends) {
      if (row_ == last_padding_row_) last_beat_ = Schedule::flush_beats - 1;
      row_ = row_ + 1;
      beat_ = 0;
    } else {
      beat_ = beat_ + 1;
    }
    return more;
  }

 private:
  beat_t beat_;
  row_t row_;
  beats_t beats_;
  rows_t rows_;
  beat_t last_beat_;  // of the current row
  row_t last_padding_row_;
  row_t flush_row_;
};

}  // namespace epiline::window
