#pragma once
#include <ap_int.h>

#include <type_traits>

#include "kernels/level_array.hpp"
#include "kernels/level_groups.hpp"
#include "window/reduce.hpp"

namespace epiline::kernels {

/// Which candidates take part: level d of the pixel in column x does iff the pixel is one of the frame, d <= x (its
/// right partner lies in the frame) and d < the number of levels asked for. All others get a cost that no
/// true one reaches, by setting the bits `Penalty` of it; so this is the one place where candidates are masked, and
/// every kernel behind it just compares costs. (All bits make one largest cost of all; a spare bit on top does the same
/// for the winner with a gate a level.)
///
/// d = 0 always takes part in a pixel of the frame.
///
/// Config: levels, parallel_disparities, pixels_per_beat.
template <class Config, class Costs, int Penalty>
class candidate_mask {
 public:
  static constexpr int lanes = Config::pixels_per_beat;
  static constexpr int levels = Config::levels;
  using groups = level_groups<Config>;

  /// `costs`: of the group's levels; x: column of lane 0; pixel_in[l]: lane l is a pixel of the frame.
  template <class Column, class Levels>
  static Costs step(const Costs& costs, Column x, const bool (&pixel_in)[lanes], Levels levels_used,
                    const level_group<Config>& group = {}) {
#pragma HLS INLINE
    using cost_t = std::remove_cv_t<std::remove_reference_t<decltype(costs.at[0][0])>>;
    using level_t = ap_uint<8>;
    Costs result;
    for (int lane = 0; lane < lanes; ++lane) {
      const auto column = x + lane;
      const level_t last_column_level = column < levels - 1 ? level_t(column) : level_t(levels - 1);
      const level_t last_level_used = levels_used - 1;
      const level_t last = last_column_level < last_level_used ? last_column_level : last_level_used;
      // Counted from the group's first level the last one is compared with constants.
      const bool any = pixel_in[lane] && group.first_level() <= last;
      const level_t last_of_group = last - group.first_level();
      for (int d = 0; d < groups::size; ++d) {
        const bool takes_part = any && level_t(window::indices<groups::size>.of[d]) <= last_of_group;
        result.at[lane][d] = takes_part ? costs.at[lane][d] : cost_t(costs.at[lane][d] | cost_t(Penalty));
      }
    }
    return result;
  }
};

}  // namespace epiline::kernels
