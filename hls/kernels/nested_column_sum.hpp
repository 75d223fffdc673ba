#pragma once
#include <ap_int.h>

#include "kernels/color.hpp"
#include "kernels/column_place.hpp"
#include "kernels/level_array.hpp"
#include "kernels/level_groups.hpp"
#include "window/bits.hpp"
#include "window/line_buffer.hpp"

namespace epiline::kernels {

/// Vertical half of three SAD windows around one centre: V3, V5 and V7, the sums of a column's absolute differences
/// over 3, 5 and 7 rows, for every level. With row y the newest, AD(k) the difference k rows above it and
///   F = AD(2) + AD(3) + AD(4) + AD(5), kept from the row before in block RAM,
/// four differences and five adders a level make all three:
///   V3 = F - AD(5),  V5 = F + AD(1),  V7 = V5 + (AD(0) + AD(6)),  next row's F = V3 + AD(1).
///
/// Border policy: columns outside the frame are 0. Rows outside are 0 because the caller passes differences of 0 there.
/// State: the RAM. The first row of a frame does not use it, so it needs no clearing.
///
/// Config: levels, parallel_disparities, pixels_per_beat, max_width.
template <class Config>
class nested_column_sum {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int groups = level_groups<Config>::count;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  static constexpr int beats = window::divide_up(Config::max_width, lanes);
  using differences = level_array<absolute_difference_t, lanes, levels>;
  template <int Rows>
  using sums = level_array<ap_uint<window::bits_for(Rows * 255)>, lanes, levels>;

  using place = column_place<lanes>;

  struct result {
    sums<3> three;
    sums<5> five;
    sums<7> seven;
  };

  /// `row0` belongs to the newest row, `row1`, `row5` and `row6` to those so many rows above it.
  /// The same beat may come again after `shortest_row` iterations at the earliest.
  result step(const differences& row0, const differences& row1, const differences& row5, const differences& row6,
              const place& at, const level_group<Config>& group) {
#pragma HLS INLINE
#pragma HLS DEPENDENCE variable = four_ type = inter distance = window::shortest_row true
    result columns;
    for (int lane = 0; lane < lanes; ++lane) {
      const int word = at.beat * groups + int(group.index());
      const bool lane_in = at.lane_in[lane];
      four_t four[levels];
      for (int d = 0; d < levels; ++d) four[d] = 0;
      if (at.in_columns && !at.first_row) {
        for (int d = 0; d < levels; ++d) four[d] = four_[word][lane][d];
      }
      for (int d = 0; d < levels; ++d) {
        const ap_uint<10> three = four[d] - row5.at[lane][d];
        const ap_uint<11> five = four[d] + row1.at[lane][d];
        const ap_uint<9> ends = row0.at[lane][d] + row6.at[lane][d];
        const ap_uint<11> seven = five + ends;
        four[d] = three + row1.at[lane][d];
        columns.three.at[lane][d] = lane_in ? three : ap_uint<10>(0);
        columns.five.at[lane][d] = lane_in ? five : ap_uint<11>(0);
        columns.seven.at[lane][d] = lane_in ? seven : ap_uint<11>(0);
      }
      if (at.in_columns) {
        for (int d = 0; d < levels; ++d) four_[word][lane][d] = four[d];
      }
    }
    return columns;
  }

 private:
  using four_t = ap_uint<window::bits_for(4 * 255)>;
  four_t four_[beats * groups][lanes][levels];
};

}  // namespace epiline::kernels
