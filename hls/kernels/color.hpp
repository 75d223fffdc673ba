#pragma once
// Colour pixels: how they lie in a video beat, and the difference of two of them.
#include <ap_int.h>

#include "window/window.hpp"

namespace epiline::kernels {

/// Bits of one pixel in a video beat: red in bits 7..0, green in 15..8, blue in 23..16; lane 0 in the low bits.
inline constexpr int color_bits = 24;

struct color {
  ap_uint<8> red;
  ap_uint<8> green;
  ap_uint<8> blue;
};

template <int Bits>
color color_of_lane(const ap_uint<Bits>& beat, int lane) {
  const int low = lane * color_bits;
  return {beat.range(low + 7, low), beat.range(low + 15, low + 8), beat.range(low + 23, low + 16)};
}

using absolute_difference_t = ap_uint<8>;
/// Sum of the absolute differences of three channels, 0 .. 765.
using color_difference_t = ap_uint<10>;

/// |a - b|. Written as "subtract, then negate if negative": whoever adds the result may add or subtract instead of
/// negating.
inline absolute_difference_t absolute_difference(ap_uint<8> a, ap_uint<8> b) {
  const ap_int<9> difference = a - b;
  return difference < 0 ? absolute_difference_t(-difference) : absolute_difference_t(difference);
}

/// The newest `Length` pixels of a row, one window a channel, so that a level's differences lie side by side in memory.
///
/// Border policy: left of the row's first pixel stand `BorderPixels` copies of it. Further taps still hold the row
/// before: they belong to candidates that are not allowed to win (d > x), whatever they cost.
/// Several parts: see row_window.
template <int Lanes, int Length, int BorderPixels, int Parts = 1>
class pixel_taps {
 public:
  void step(const color (&beat)[Lanes], bool row_starts, int part = 0) {
#pragma HLS INLINE
    ap_uint<8> channel[3][Lanes];
    for (int lane = 0; lane < Lanes; ++lane) {
      channel[0][lane] = beat[lane].red;
      channel[1][lane] = beat[lane].green;
      channel[2][lane] = beat[lane].blue;
    }
    red.step(channel[0], row_starts, part);
    green.step(channel[1], row_starts, part);
    blue.step(channel[2], row_starts, part);
  }

  using channel_window = window::row_window<ap_uint<8>, Lanes, Length, window::replicated_border<BorderPixels>, Parts>;
  channel_window red;
  channel_window green;
  channel_window blue;
};

}  // namespace epiline::kernels
