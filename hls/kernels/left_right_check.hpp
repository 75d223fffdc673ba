#pragma once
#include <ap_int.h>

#include "kernels/disparity.hpp"
#include "kernels/level_groups.hpp"
#include "kernels/right_winner.hpp"
#include "window/bits.hpp"
#include "window/delay_line.hpp"

namespace epiline::kernels {

/// Keeps the disparity d of left pixel x only if the right pixel it points at agrees: |d - dR(x - d)| <= 1.
///
/// State: the chain of right_winner; the finished right disparities of the last beats in a circular RAM, which is read
/// at x - d (a copy a lane); the left beats that wait until then. The RAM is read `lookup_distance` beats after the
/// youngest word was written, which leaves the pipeline that many clocks between the write and the read.
///
/// Config: levels, parallel_disparities, pixels_per_beat, window_radius, max_width.
template <class Config>
class left_right_check {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int lookup_distance = 8;
  static constexpr int delay_beats = right_winner<Config>::delay_beats + lookup_distance;
  using costs_t = typename right_winner<Config>::costs_t;

  /// `costs`: masked, of the group, of the beat `found`, which is looked at in the last group. There the result is
  /// valid: it belongs to the beat of `delay_beats` beats ago.
  disparity_beat_of<lanes> step(const costs_t& costs, const disparity_beat_of<lanes>& found, bool enabled,
                                const level_group<Config>& group) {
#pragma HLS INLINE
    const right_beat newest_right = chain_.step(costs, group);
    disparity_beat_of<lanes> checked = found;
    if (group.last()) checked = check(newest_right, found, enabled);
    return checked;
  }

 private:
  using right_beat = typename right_winner<Config>::right_beat;

  disparity_beat_of<lanes> check(const right_beat& newest_right, const disparity_beat_of<lanes>& found, bool enabled) {
#pragma HLS INLINE
#pragma HLS DEPENDENCE variable = right_ type = inter distance = lookup_distance true
    disparity_beat_of<lanes> checked = left_.step(found);
    for (int lane = 0; lane < lanes; ++lane) {
      const disparity_t d = checked.pixel[lane].disparity;
      // The partner's distance in pixels from the left beat's last lane.
      const ap_uint<9> distance = d + (lanes - 1 - lane);
      const pointer_t partner_beat = pointer_ - lookup_distance - distance / lanes;
      const right_beat partners = right_[partner_beat];
      disparity_t partner = 0;
      for (int i = 0; i < lanes; ++i) {
        if (distance % lanes == lanes - 1 - i) partner = partners.disparity[i];
      }
      const bool agrees = d <= partner + 1 && partner <= d + 1;
      if (enabled && !agrees) checked.pixel[lane].defined = 0;
    }
    right_[pointer_] = newest_right;
    pointer_ = pointer_ + 1;
    return checked;
  }

  // The oldest word wanted: lookup_distance beats and the beats of the largest disparity ago.
  using pointer_t = ap_uint<window::bits_for(lookup_distance + window::divide_up(Config::levels - 1, lanes) + 1)>;
  static constexpr int words = 1 << pointer_t::width;

  right_winner<Config> chain_;
  window::delay_line<disparity_beat_of<lanes>, delay_beats> left_;
  right_beat right_[words];
  pointer_t pointer_;
};

}  // namespace epiline::kernels
