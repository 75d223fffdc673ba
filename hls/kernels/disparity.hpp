#pragma once
#include <ap_int.h>

namespace epiline::kernels {

/// A disparity in levels, 0 .. 127.
using disparity_t = ap_uint<7>;

/// A pixel's disparity on its way to the output. Whether there is one is a bit of its own, never a magic disparity.
struct disparity_pixel {
  disparity_t disparity;
  ap_uint<1> defined;
  ap_uint<1> in_frame;  // 0: the lane lies outside the frame and must never become defined
};

/// What a beat means to the output.
struct beat_marks {
  ap_uint<1> in_frame;    // the beat is written
  ap_uint<1> first_beat;  // of the frame
  ap_uint<1> last_of_row;
};

/// The beats that flow from the winner to the output.
template <int Lanes>
struct disparity_beat_of {
  disparity_pixel pixel[Lanes];
  beat_marks marks;
};

}  // namespace epiline::kernels
