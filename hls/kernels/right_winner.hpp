#pragma once
#include <ap_int.h>

#include "kernels/color_sad.hpp"
#include "kernels/disparity.hpp"
#include "kernels/level_groups.hpp"
#include "window/reduce.hpp"

namespace epiline::kernels {

/// Disparity of the right image from the costs of the left one: dR(xr) = argmin over d of C(xr + d, d), tie: smallest
/// d.
///
/// A chain of candidates walks against the raster: the entry of right pixel xr meets C(xr + d, d) when left pixel xr +
/// d passes, so one entry meets its levels in rising order and "strictly less" keeps the smallest d of a tie. Entries
/// shift on with every beat, also over the ends of rows: candidates that do not belong together are masked (they cost
/// the maximum, see candidate_mask), so they never win. There is no feedback but the shift.
///
/// A group of levels is a part of the chain: a beat moves all entries on by one, and what leaves a part enters the
/// next.
///
/// State: the chain. Entries of an earlier row or frame meet masked costs only; nothing needs a reset.
///
/// Config: levels, parallel_disparities, pixels_per_beat, window_radius, max_width.
template <class Config>
class right_winner {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int groups = level_groups<Config>::count;
  static constexpr int levels = level_groups<Config>::size;  // of a group
  /// The result belongs to the right beat in the column of the left beat this many beats ago.
  static constexpr int delay_beats = window::divide_up(Config::levels - 1, lanes);
  using costs_t = typename color_sad<Config>::costs;
  using cost_t = typename color_sad<Config>::cost_t;

  struct right_beat {
    disparity_t disparity[lanes];
  };

  /// The result is valid in the beat's last group.
  right_beat step(const costs_t& costs, const level_group<Config>& group) {
#pragma HLS INLINE
    // Entry e of the group's part (counted from its first level) belongs to the right pixel e columns left of the
    // newest lane, so lane l is its partner at level e - (lanes - 1 - l). The lanes of a beat compete among themselves
    // first: the chain holds one comparison a step, and need not be skewed over the pipeline.
    cost_t offered[entries];
    disparity_t level[entries];
    for (int entry = 0; entry < levels; ++entry) {
      offered[entry] = costs.at[lanes - 1][entry];
      level[entry] = group.first_level() + window::indices<levels>.of[entry];
    }
    for (int entry = levels; entry < entries; ++entry) {
      offered[entry] = ~cost_t(0);
      level[entry] = 0;
    }
    for (int lane = lanes - 2; lane >= 0; --lane) {
      const int first = lanes - 1 - lane;
      for (int d = 0; d < levels; ++d) {
        const cost_t cost = costs.at[lane][d];
        const bool better = cost <= offered[first + d];  // of two lanes the left one has the smaller level
        offered[first + d] = better ? cost : offered[first + d];
        level[first + d] = better ? disparity_t(window::indices<levels>.of[d]) : level[first + d];
      }
    }
    for (int entry = 0; entry < lanes; ++entry) {  // those who join the chain, or come from the part before
      lowest_[front][entry] = group.first() ? cost_t(~cost_t(0)) : passed_on_lowest_;
      disparity_[front][entry] = group.first() ? disparity_t(0) : passed_on_disparity_;
    }
    if constexpr (groups > 1) {
      passed_on_lowest_ = lowest_[front][entries];
      passed_on_disparity_ = disparity_[front][entries];
    }
    cost_t lowest[entries];
    disparity_t disparity[entries];
    for (int entry = 0; entry < entries; ++entry) {
      const bool better = offered[entry] < lowest_[front][entry];
      lowest[entry] = better ? offered[entry] : lowest_[front][entry];
      disparity[entry] = better ? level[entry] : disparity_[front][entry];
    }
    right_beat finished;
    for (int lane = 0; lane < lanes; ++lane) finished.disparity[lane] = disparity[entries - 1 - lane];
    move_groups_on(lowest_);
    move_groups_on(disparity_);
    for (int entry = lanes; entry < places; ++entry) lowest_[0][entry] = lowest[entry - lanes];
    for (int entry = lanes; entry < places; ++entry) disparity_[0][entry] = disparity[entry - lanes];
    return finished;
  }

 private:
  static constexpr int entries = window::divide_up(levels - 1 + lanes, lanes) * lanes;
  static constexpr int places = groups == 1 ? entries : entries + 1;  // with the one that enters the next part
  static constexpr int front = groups - 1;
  cost_t lowest_[groups][places];
  disparity_t disparity_[groups][places];
  cost_t passed_on_lowest_;
  disparity_t passed_on_disparity_;
};

}  // namespace epiline::kernels
