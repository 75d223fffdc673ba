#pragma once
#include <ap_int.h>

#include "window/bits.hpp"

namespace epiline::window {

/// Walks over a frame, one beat a step: `rows` rows of real beats, then Schedule::padding_rows more, each row
/// followed by Schedule::padding_beats beats outside the frame; at last Schedule::flush_beats iterations that let the
/// kernels' delays run out. One flat counter pair instead of two nested loops: the only feedback is "equal, then 0 else
/// plus 1". A row has at least Schedule::minimum_row_beats iterations, so a RAM addressed by the beat meets the same
/// address again after that many iterations at the earliest, whatever the width.
///
/// Schedule: named constants maximum_beats, maximum_rows, padding_beats, padding_rows, flush_beats, minimum_row_beats.
template <class Schedule>
class raster {
  static_assert(Schedule::minimum_row_beats >= 2 && Schedule::flush_beats >= 2, "a row ends after its first beat");

 public:
  static constexpr int longest_row = larger(
      larger(Schedule::maximum_beats + Schedule::padding_beats, Schedule::minimum_row_beats), Schedule::flush_beats);
  using beats_t = ap_uint<bits_for(Schedule::maximum_beats)>;
  using rows_t = ap_uint<bits_for(Schedule::maximum_rows)>;
  using beat_t = ap_uint<bits_for(longest_row)>;
  using row_t = ap_uint<bits_for(Schedule::maximum_rows + Schedule::padding_rows + 1)>;

  /// Begins a frame of `beats` x `rows` (both at least 1).
  raster(beats_t beats, rows_t rows)
      : beat_(0),
        row_(0),
        row_ends_(false),
        columns_end_(beats == 1),
        frame_rows_end_(false),
        padding_rows_end_(false),
        in_rows_(true),
        in_columns_(true),
        in_frame_(true),
        in_flush_(false) {
    one_beat_ = beats == 1;
    last_frame_beat_but_one_ = beats - 2;
    last_frame_row_ = rows - 1;
    last_padding_row_ = rows + Schedule::padding_rows - 1;
    const beat_t wanted = beats - 1 + Schedule::padding_beats;
    const beat_t last_row_beat =
        wanted < Schedule::minimum_row_beats - 1 ? beat_t(Schedule::minimum_row_beats - 1) : wanted;
    last_row_beat_but_one_ = last_row_beat - 1;
  }

  beat_t beat() const { return beat_; }
  row_t row() const { return row_; }
  /// The beat lies in the columns of the frame.
  bool in_columns() const { return in_columns_; }
  /// The beat is one of the frame: streams are read.
  bool in_frame() const { return in_frame_; }
  bool in_flush() const { return in_flush_; }

  /// Goes on to the next beat; false after the last one.
  bool advance() {
    const bool more = !(row_ends_ && in_flush_);
    // A row has two beats at least: what its first beat finds out is there when the row ends.
    const bool frame_rows_end = row_ == last_frame_row_;
    const bool padding_rows_end = row_ == last_padding_row_;
    if (row_ends_) {
      if (frame_rows_end_) in_rows_ = false;
      in_frame_ = in_rows_;
      if (padding_rows_end_) in_flush_ = true;
      row_ = row_ + 1;
      row_ends_ = false;
      beat_ = 0;
      in_columns_ = true;
      columns_end_ = one_beat_;
    } else {
      row_ends_ = in_flush_ ? beat_ == Schedule::flush_beats - 2 : beat_ == last_row_beat_but_one_;
      if (columns_end_) {
        in_columns_ = false;
        in_frame_ = false;
      }
      columns_end_ = beat_ == last_frame_beat_but_one_;
      beat_ = beat_ + 1;
    }
    frame_rows_end_ = frame_rows_end;
    padding_rows_end_ = padding_rows_end;
    return more;
  }

 private:
  // Where the walk is: every flag is a register of its own, so that what depends on it (the reading of streams) does
  // not wait for a comparison. What ends is known a beat before: whether there is another iteration hangs on it.
  beat_t beat_;
  row_t row_;
  bool row_ends_;
  bool columns_end_;
  bool frame_rows_end_;    // with this row
  bool padding_rows_end_;  // with this row
  bool in_rows_;
  bool in_columns_;
  bool in_frame_;
  bool in_flush_;
  // Constants of the frame, which nothing changes on the way: their making may take its time before the first beat.
  // Comparing for equality is quicker than for order.
  beat_t last_row_beat_but_one_;    // of every row but the flush
  beat_t last_frame_beat_but_one_;  // of one beat: a beat that no row reaches
  bool one_beat_;                   // a row of the frame
  row_t last_frame_row_;
  row_t last_padding_row_;
};

/// Tells when delays of up to `Steps` steps have run full, as the flush lets them run out.
template <int Steps>
class warm_up {
 public:
  /// True from step `Steps` + 1 on.
  bool step() {
    const bool filled = left_ == 0;
    if (!filled) left_ = left_ - 1;
    return filled;
  }

 private:
  ap_uint<bits_for(Steps)> left_ = Steps;
};

}  // namespace epiline::window
