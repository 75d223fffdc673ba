#pragma once
#include <ap_int.h>

#include "kernels/disparity.hpp"
#include "kernels/level_array.hpp"
#include "kernels/level_groups.hpp"
#include "window/reduce.hpp"

namespace epiline::kernels {

/// Winner takes all: the level of the lowest cost, of equal costs the smallest level, for every lane, and that cost.
/// `costs`: masked (see candidate_mask). A pixel is defined iff it is one of the frame (pixel_in).
template <int Lanes, int Levels, int CostBits>
void pick_winners(const level_array<ap_uint<CostBits>, Lanes, Levels>& costs, const bool (&pixel_in)[Lanes],
                  disparity_pixel (&winner)[Lanes], ap_uint<CostBits> (&lowest)[Lanes]) {
#pragma HLS INLINE
  for (int lane = 0; lane < Lanes; ++lane) {
    const auto smallest = window::minimum<window::smallest_index_wins>(costs.at[lane]);
    lowest[lane] = smallest.value;
    winner[lane].disparity = smallest.index;
    winner[lane].defined = pixel_in[lane];
    winner[lane].in_frame = pixel_in[lane];
  }
}

/// The winner of all levels from those of the groups, which come one an iteration, the lowest levels first: "strictly
/// less" keeps the smallest level of a tie. State: the best so far.
///
/// Config: levels, parallel_disparities, pixels_per_beat.
template <class Config, class Cost>
class best_of_groups {
 public:
  static constexpr int lanes = Config::pixels_per_beat;

  /// Takes what pick_winners gave for the group; in the beat's last group it leaves the winner of all.
  void step(disparity_pixel (&winner)[lanes], Cost (&lowest)[lanes], const level_group<Config>& group) {
#pragma HLS INLINE
    if constexpr (level_groups<Config>::count > 1) {
      for (int lane = 0; lane < lanes; ++lane) {
        const bool better = group.first() || lowest[lane] < lowest_[lane];
        disparity_[lane] = better ? disparity_t(winner[lane].disparity + group.first_level()) : disparity_[lane];
        lowest_[lane] = better ? lowest[lane] : lowest_[lane];
        winner[lane].disparity = disparity_[lane];
        lowest[lane] = lowest_[lane];
      }
    }
  }

 private:
  disparity_t disparity_[lanes];
  Cost lowest_[lanes];
};

}  // namespace epiline::kernels
