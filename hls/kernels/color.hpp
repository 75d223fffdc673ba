#pragma once
// Colour pixels: how they lie in a video beat, and the difference of two of them.
#include <ap_int.h>

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
  return difference < 0 ? ap_int<9>(-difference) : difference;
}

/// The newest `Length` pixels of a row, one array a channel. Tap 0 is the last lane of the newest beat, the pixel
/// nearest to the right edge.
///
/// Border policy: left of the row's first pixel stand `BorderPixels` copies of it. Further taps still hold the row
/// before: they belong to candidates that are not allowed to win (d > x), whatever they cost.
template <int Lanes, int Length, int BorderPixels>
class pixel_taps {
 public:
  static_assert(Length >= Lanes);

  void step(const color (&beat)[Lanes], bool row_starts) {
#pragma HLS INLINE
    for (int tap = Length - 1; tap >= Lanes; --tap) red[tap] = red[tap - Lanes];
    for (int tap = Length - 1; tap >= Lanes; --tap) green[tap] = green[tap - Lanes];
    for (int tap = Length - 1; tap >= Lanes; --tap) blue[tap] = blue[tap - Lanes];
    for (int lane = 0; lane < Lanes; ++lane) set(Lanes - 1 - lane, beat[lane]);
    if (row_starts) {
      for (int tap = Lanes; tap < Lanes + BorderPixels && tap < Length; ++tap) set(tap, beat[0]);
    }
  }

  ap_uint<8> red[Length];
  ap_uint<8> green[Length];
  ap_uint<8> blue[Length];

 private:
  void set(int tap, const color& pixel) {
    red[tap] = pixel.red;
    green[tap] = pixel.green;
    blue[tap] = pixel.blue;
  }
};

}  // namespace epiline::kernels
