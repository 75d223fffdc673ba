#pragma once
#include <ap_int.h>

#include "kernels/disparity.hpp"
#include "kernels/level_array.hpp"
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

}  // namespace epiline::kernels
