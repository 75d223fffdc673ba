#pragma once
#include <ap_int.h>

#include "kernels/disparity.hpp"
#include "kernels/fuzzy_inference.hpp"
#include "kernels/fuzzy_rule_base.hpp"
#include "window/bits.hpp"
#include "window/window.hpp"

namespace epiline::kernels {

/// One pass of the fuzzy filter over a row: centre c = D(i, j), neighbours l = D(i, j - r), r = D(i, j + r).
///
/// c defined: inference over u = |c - l|, v = |c - r|, w = |l - r|, a difference with an undefined operand is far.
/// Defuzzification is largest-of-maximum: of the output sets with the highest degree the largest defined disparity
/// (centre: c, neighbours: the larger of l and r); undefined if there is none. c undefined: both neighbours defined:
/// the larger one if they are not far from each other, else the smaller one (the background); one neighbour defined:
/// that one. With careful filling only: both defined and not far, the larger one.
///
/// Border policy: neighbours outside the row are undefined, which the caller provides by at least r lanes outside the
/// frame between two rows. Lanes outside never become defined. State: the row's last pixels in registers.
///
/// Config: pixels_per_beat, fuzzy_radius, rule_base (labels and sets as in fuzzy_rule_base.hpp).
template <class Config>
class fuzzy_filter {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int radius = Config::fuzzy_radius;
  static constexpr int delay_beats = window::divide_up(radius, lanes);
  using beat = disparity_beat_of<lanes>;

  /// Takes the newest beat, returns the one of `delay_beats` steps ago: filtered, or unchanged if not `enabled`.
  beat step(const beat& newest, bool enabled, bool careful_fill) {
#pragma HLS INLINE
    row_.step(newest.pixel, false);
    beat result;
    for (int lane = 0; lane < lanes; ++lane) {
      const int tap = delay_beats * lanes + lanes - 1 - lane;
      const disparity_pixel filtered =
          filter(row_.tap[tap], row_.tap[tap + radius], row_.tap[tap - radius], careful_fill);
      result.pixel[lane] = enabled ? filtered : row_.tap[tap];
    }
    result.marks = marks_[delay_beats - 1];
    for (int i = delay_beats - 1; i > 0; --i) marks_[i] = marks_[i - 1];
    marks_[0] = newest.marks;
    return result;
  }

  static disparity_pixel filter(const disparity_pixel& c, const disparity_pixel& l, const disparity_pixel& r,
                                bool careful_fill) {
#pragma HLS INLINE
    const disparity_t larger = l.disparity < r.disparity ? r.disparity : l.disparity;
    const disparity_t smaller = l.disparity < r.disparity ? l.disparity : r.disparity;
    const bool both = l.defined && r.defined;
    const disparity_t larger_defined = both ? larger : l.defined ? l.disparity : r.disparity;
    const bool any = l.defined || r.defined;

    const auto w = inference::fuzzify(difference(l, r), both);
    const auto degree = inference::infer(inference::fuzzify(difference(c, l), c.defined && l.defined),
                                         inference::fuzzify(difference(c, r), c.defined && r.defined), w);
    const auto at_least_as_high = [&degree](disparity_set a, disparity_set b) {
      return degree.set[a] >= degree.set[b];
    };
    const bool take_centre = at_least_as_high(centre, neighbours) && at_least_as_high(centre, undefined);
    const bool take_neighbours = any && at_least_as_high(neighbours, centre) && at_least_as_high(neighbours, undefined);

    const bool neighbours_far = w.label[far] >= (1 << (inference::degree_bits - 1));

    disparity_pixel result = c;
    if (c.defined) {
      const bool neighbours_win = take_neighbours && (!take_centre || c.disparity < larger_defined);
      result.disparity = neighbours_win ? larger_defined : c.disparity;
      result.defined = take_centre || take_neighbours;
    } else {
      result.disparity = both && neighbours_far ? smaller : larger_defined;
      result.defined = careful_fill ? both && !neighbours_far : any;
    }
    if (!c.in_frame) result.defined = 0;
    return result;
  }

 private:
  using inference = fuzzy_inference<typename Config::rule_base>;
  static constexpr int taps = delay_beats * lanes + lanes + radius;

  static disparity_t difference(const disparity_pixel& a, const disparity_pixel& b) {
    const ap_int<8> difference = a.disparity - b.disparity;
    return difference < 0 ? ap_int<8>(-difference) : difference;
  }

  window::row_window<disparity_pixel, lanes, taps, window::previous_row_border> row_;
  beat_marks marks_[delay_beats];
};

}  // namespace epiline::kernels
