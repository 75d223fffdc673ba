#pragma once
#include <ap_int.h>

#include "kernels/label_window.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// How many of the 40 cells of the 7x7 around a centre but outside its 3x3 equal each of these 9 near cells.
///
/// The near cells of one centre are those of its neighbours, too: a pixel P in one of the three near rows is compared
/// once with the cells of every column up to 4 to its left and right, and what each column counts serves all three
/// centres that P is near to while they pass. P being `right` columns right of the centre (-1, 0, 1), the ring is
///   the rows 2 and 3 above and below ("apart"): from P the columns -3 - right .. 3 - right,
///   the near rows ("beside"): the columns -3 - right and -2 - right, 2 - right and 3 - right.
/// Columns up to P are counted when P is the newest, those right of it as they come; the last one of a ring is the
/// newest column, and then its count is complete. No feedback: sums move on to the next column.
///
/// State: sums of the last columns. Undefined labels are counted like others; nobody asks for their counts.
///
/// Config: pixels_per_beat, max_width.
template <class Config>
class ring_counts {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  using count_t = ap_uint<8>;  // 0 .. 40; as wide as the labels, which keeps native vectors full

  /// [lane][1 + down][1 + right], of the centres of the window.
  struct result {
    count_t of[lanes][3][3];
  };

  /// `labels`: after its step.
  result step(const label_window<Config, 3>& labels) {
#pragma HLS INLINE
    result counts;
    for (int down = -1; down <= 1; ++down) {
      sums newest[lanes];
      for (int lane = 0; lane < lanes; ++lane) {
        const sums& before = lane == 0 ? columns_[1 + down].tap[0] : newest[lane - 1];
        newest[lane] = sums_of(labels, lane, down, before);
        for (int right = -1; right <= 1; ++right) {
          const int end = 3 - right;  // the ring's last column, which is the newest, from P
          counts.of[lane][1 + down][1 + right] =
              newest[lane].apart[end] + (newest[lane].beside[end] + before.beside[end - 1]);
        }
      }
      columns_[1 + down].step(newest, false);
      for (int lane = 0; lane < lanes; ++lane) {
        for (int right = -1; right <= 1; ++right) {
          counts.of[lane][1 + down][1 + right] = counts.of[lane][1 + down][1 + right] +
                                                 columns_[1 + down].tap[lanes - 1 - lane + 3 - right].left[1 + right];
        }
      }
    }
    return counts;
  }

 private:
  static constexpr int reach = 4;

  /// What a near row counts at a column. Index k: for the pixel k columns before it.
  struct sums {
    count_t apart[reach + 1];   // up to this column from the one right of the pixel
    count_t beside[reach + 1];  // in this column
    count_t left[3];            // [1 + right]: of the pixel in this column, up to its own column
  };

  static sums sums_of(const label_window<Config, 3>& labels, int lane, int down, const sums& before) {
#pragma HLS INLINE
    constexpr int newest = 3;  // the window's last column
    const label_t pixel = labels.cell(lane, down, newest);
    count_t apart_before[reach + 1];  // in the column k before, those equal to the newest pixel
    count_t beside_before[reach + 1];
    sums at;
    for (int k = 0; k <= reach; ++k) apart_before[k] = beside_before[k] = at.apart[k] = at.beside[k] = 0;
    for (int row = -3; row <= 3; ++row) {
      const bool is_near = row >= -1 && row <= 1;
      count_t(&counted)[reach + 1] = is_near ? at.beside : at.apart;
      count_t(&counted_before)[reach + 1] = is_near ? beside_before : apart_before;
      const label_t cell = labels.cell(lane, row, newest);
      for (int k = 0; k <= reach; ++k) {
        counted[k] = counted[k] + count_t(labels.cell(lane, down, newest - k) == cell);
        counted_before[k] = counted_before[k] + count_t(pixel == labels.cell(lane, row, newest - k));
      }
    }
    for (int k = reach; k > 1; --k) at.apart[k] = at.apart[k] + before.apart[k - 1];
    count_t apart = apart_before[0] + apart_before[1] + apart_before[2];
    for (int right = -1; right <= 1; ++right) {
      at.left[1 + right] = apart + (beside_before[3 + right] + beside_before[2 + right]);
      if (right < 1) apart = apart + apart_before[4 + right];
    }
    return at;
  }

  window::row_window<sums, lanes, lanes + reach> columns_[3];  // of the near rows
};

}  // namespace epiline::kernels
