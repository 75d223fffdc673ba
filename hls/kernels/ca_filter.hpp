#pragma once
#include <ap_int.h>

#include "kernels/disparity.hpp"
#include "kernels/label_window.hpp"
#include "kernels/ring_counts.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// Cellular automaton on the binary planes of all levels, equations (3) and (4) of the paper, without the planes: only
/// a level present in a pixel's 3x3 neighbourhood can claim the pixel, so labels are enough.
///   rule 1: no neighbour of 8 set: 0; at least 7 of 8 set: 1 (and the pixel leaves its old plane); else unchanged.
///   rule 2, on the result of rule 1: at least one of the 3x3 set and at least `ring` of the 40 cells of the 7x7 around
///   it: 1, else 0.
/// A pixel claimed by exactly one level gets it; by none or by several: undefined.
///
/// Lane l of the result belongs to the pixel `delay_rows` rows above and `delay_beats` beats before the newest one.
/// Border policy: see label_window; pixels outside the frame are set in no plane, and no rule sets them.
/// State: the two windows, the counts of the second one, and what belongs to the beats between them.
///
/// Config: pixels_per_beat, max_width.
template <class Config>
class ca_filter {
  using near_window = label_window<Config, 1>;
  using ring_window = label_window<Config, 3>;

 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int delay_rows = 1 + 3;
  static constexpr int delay_beats = near_window::delay_beats + ring_window::delay_beats;
  using ring_t = ap_uint<6>;

  struct place {
    int beat;              // of the row, may lie outside the frame
    bool in_columns;       // the beat lies in the columns of the frame
    bool in_frame[lanes];  // the pixel `delay_rows` above lies in the frame
    beat_marks marks;      // of the beat `delay_rows` above
  };

  /// `newest`: defined only inside the frame. Not `enabled`: labels pass unchanged. `ring`: 1 .. 40.
  disparity_beat_of<lanes> step(const disparity_pixel (&newest)[lanes], const place& at, bool enabled, ring_t ring) {
#pragma HLS INLINE
    label_t labels[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      labels[lane] = newest[lane].defined ? label_t(label_t(defined) | newest[lane].disparity) : label_t(0);
    }
    near_.step(labels, at.beat, at.in_columns);
    const place newest_place[1] = {at};
    places_.step(newest_place, false);

    label_t settled[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      settled[lane] = enabled ? rule1(near_, lane) : near_.cell(lane, 0, 0);
    }
    const place& at_ring = places_.tap[near_window::delay_beats];
    ring_.step(settled, at_ring.beat, at_ring.in_columns);
    const auto support = support_.step(ring_);

    const place& at_result = places_.tap[delay_beats];
    disparity_beat_of<lanes> result;
    for (int lane = 0; lane < lanes; ++lane) {
      const label_t label = enabled ? rule2(ring_, lane, support.of[lane], ring) : ring_.cell(lane, 0, 0);
      result.pixel[lane].disparity = label;
      result.pixel[lane].defined = at_result.in_frame[lane] && (label & defined) != 0;
      result.pixel[lane].in_frame = at_result.in_frame[lane];
    }
    result.marks = at_result.marks;
    return result;
  }

 private:
  static constexpr int defined = 0x80;
  using count_t = typename ring_counts<Config>::count_t;

  /// A level set in 7 of 8 neighbours is set in one of any two of them.
  static label_t rule1(const near_window& labels, int lane) {
#pragma HLS INLINE
    const label_t centre = labels.cell(lane, 0, 0);
    label_t neighbour[8];
    int count = 0;
    for (int down = -1; down <= 1; ++down) {
      for (int right = -1; right <= 1; ++right) {
        if (down != 0 || right != 0) neighbour[count++] = labels.cell(lane, down, right);
      }
    }
    if (is_born(neighbour[0], neighbour)) return neighbour[0];
    if (is_born(neighbour[1], neighbour)) return neighbour[1];
    return equal_cells(centre, neighbour) >= 1 ? centre : label_t(0);
  }

  static bool is_born(label_t label, const label_t (&neighbour)[8]) {
    return (label & defined) != 0 && equal_cells(label, neighbour) >= 7;
  }

  /// `support[1 + down][1 + right]`: how many cells of the ring equal that near cell.
  static label_t rule2(const ring_window& labels, int lane, const count_t (&support)[3][3], ring_t ring) {
#pragma HLS INLINE
    // All who claim the pixel are of one level iff their labels' union is their intersection.
    label_t any = 0;
    label_t all = ~label_t(0);
    for (int down = -1; down <= 1; ++down) {
      for (int right = -1; right <= 1; ++right) {
        const label_t near = labels.cell(lane, down, right);
        const bool claims = (near & defined) != 0 && support[1 + down][1 + right] >= ring;
        any = any | (claims ? near : label_t(0));
        all = all & (claims ? near : label_t(~label_t(0)));
      }
    }
    return any == all ? any : label_t(0);
  }

  /// How many of cells[First .. First + Count - 1] equal the label: a tree whose leaves keep their order in memory,
  /// which natively becomes one comparison of vectors.
  template <int First, int Count, int Size>
  static count_t equal_cells_of(label_t label, const label_t (&cells)[Size]) {
    if constexpr (Count == 1) {
      return cells[First] == label;
    } else {
      constexpr int half = Count / 2;
      return equal_cells_of<First, half>(label, cells) + equal_cells_of<First + half, Count - half>(label, cells);
    }
  }
  template <int Size>
  static count_t equal_cells(label_t label, const label_t (&cells)[Size]) {
    return equal_cells_of<0, Size>(label, cells);
  }

  near_window near_;
  ring_window ring_;
  ring_counts<Config> support_;
  window::row_window<place, 1, delay_beats + 1> places_;
};

}  // namespace epiline::kernels
