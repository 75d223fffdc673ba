#pragma once
#include <ap_int.h>

#include "kernels/color_sad.hpp"
#include "kernels/disparity.hpp"
#include "kernels/level_groups.hpp"
#include "window/delay_line.hpp"
#include "window/reduce.hpp"

namespace epiline::kernels {

/// Keeps a winner dL with cost m1 only if every rival costs clearly more:
///   16 * C(d) >= ratio * m1 for all d with |d - dL| > 1,
/// which is 16 * m2 >= ratio * m1 for the smallest rival m2, without searching it: every rival is compared with the one
/// threshold ceil(ratio * m1 / 16). No rival: kept. A ratio of 0 keeps all.
///
/// The rivals are known only after the winner, so all costs wait in block RAM for `Config::uniqueness_delay`
/// iterations, which must cover the pipeline depth of the winner's tree, and with several groups of levels for those
/// that come behind them; they come out beside the winner. With a delay of 0 and one group the pipeline itself makes
/// them wait, in LUT RAM beside what needs them: half the block RAMs of two pixels a beat, whose wires go all over the
/// device, for some more LUTs.
///
/// Config: levels, parallel_disparities, pixels_per_beat, window_radius, max_width, uniqueness_delay.
template <class Config>
class uniqueness_check {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int groups = level_groups<Config>::count;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  static constexpr int delay_beats = window::divide_up(Config::uniqueness_delay + groups - 1, groups);
  static_assert(groups == 1 || Config::uniqueness_delay > 0, "groups of levels need a uniqueness_delay");
  using costs_t = typename color_sad<Config>::costs;
  using cost_t = typename color_sad<Config>::cost_t;
  using ratio_t = ap_uint<5>;

  struct result {
    costs_t costs;
    disparity_beat_of<lanes> found;
  };

  /// `costs`: masked (see candidate_mask); `lowest[l]`: the cost of found.pixel[l]; `ratio` in sixteenths.
  /// `costs` of the group; `found` and `lowest` are looked at in the beat's last one.
  /// The result belongs to the beat of `delay_beats` beats ago; `found` is valid in the last group.
  result step(const costs_t& costs, const disparity_beat_of<lanes>& found, const cost_t (&lowest)[lanes], ratio_t ratio,
              const level_group<Config>& group) {
#pragma HLS INLINE
    waiting_winners newest;
    newest.found = found;
    for (int lane = 0; lane < lanes; ++lane) newest.threshold[lane] = threshold(lowest[lane], ratio);
    result out;
    if constexpr (delay_beats == 0) {
      now_ = newest;
      out.costs = costs;
    } else {
      if (group.first()) now_ = winners_.oldest();
      if (group.last()) winners_.push(newest);
      out.costs = costs_.step(costs);
    }
    for (int lane = 0; lane < lanes; ++lane) {
      if (has_rival(out.costs.at[lane], now_.found.pixel[lane].disparity, now_.threshold[lane], group.first_level())) {
        now_.found.pixel[lane].defined = 0;
      }
    }
    out.found = now_.found;
    return out;
  }

 private:
  struct waiting_winners {
    disparity_beat_of<lanes> found;
    cost_t threshold[lanes];
  };

  static cost_t threshold(cost_t lowest, ratio_t ratio) {
    const ap_uint<18> rounded_up = (lowest * ratio + 15) >> 4;
    return rounded_up > cost_t(~cost_t(0)) ? cost_t(~cost_t(0)) : cost_t(rounded_up);  // no cost lies between the two
  }

  static bool has_rival(const cost_t (&costs)[levels], disparity_t winner, cost_t threshold, disparity_t first_level) {
    const ap_uint<8> last_neighbour = winner + 1;
    const ap_uint<8> first_neighbour = winner == 0 ? ap_uint<8>(0) : ap_uint<8>(winner - 1);
    ap_uint<1> rival[levels];
    for (int d = 0; d < levels; ++d) {
      const ap_uint<8> level = first_level + window::indices<levels>.of[d];
      rival[d] = costs[d] < threshold && (level < first_neighbour || level > last_neighbour);
    }
    return window::reduce(rival, [](ap_uint<1> a, ap_uint<1> b) -> ap_uint<1> { return a | b; }) != 0;
  }

  static constexpr int line_beats = delay_beats == 0 ? 1 : delay_beats;  // nobody uses the line of a delay of 0
  window::delay_line<waiting_winners, line_beats> winners_;
  window::delay_line<costs_t, line_beats * groups> costs_;
  waiting_winners now_;  // of the beat whose costs have waited
};

}  // namespace epiline::kernels
