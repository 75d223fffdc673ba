#pragma once
// What the tops of all stereo methods share: the beats that come in and go out.
#include <ap_axi_sdata.h>
#include <ap_int.h>

#include "kernels/color.hpp"
#include "kernels/disparity.hpp"
#include "window/bits.hpp"
#include "window/line_buffer.hpp"

namespace epiline::tops {

/// A method's configuration for small devices and quick experiments.
template <class Full>
struct few_levels_of : Full {
  static constexpr int max_width = 64;
  static constexpr int max_height = 255;
  static constexpr int levels = 8;
};

/// A method's configuration at twice the frames a second and the same clock.
template <class Full>
struct two_pixels_a_beat_of : Full {
  static constexpr int pixels_per_beat = 2;
  static constexpr int uniqueness_delay = 0;  // of the methods that have that check
};

/// What all methods' walks over a frame have in common; see window::raster.
template <class Config>
struct stereo_schedule {
  static constexpr int maximum_beats = window::divide_up(Config::max_width, Config::pixels_per_beat);
  static constexpr int maximum_rows = Config::max_height;
  static constexpr int minimum_row_beats = window::shortest_row;
};

/// The types of a configuration's interface. Config: max_width, max_height, levels, pixels_per_beat.
template <class Config>
struct stereo_interface {
  static_assert(Config::levels >= 1 && Config::levels <= 128, "disparities have 7 bits");
  static constexpr int lanes = Config::pixels_per_beat;

  /// Pixels of the left or right image: 24 bits a lane, red in the low byte, lane 0 in the low bits. Only data is
  /// looked at.
  using video_beat = ap_axiu<lanes * kernels::color_bits, 1, 0, 0>;
  /// Disparities: 8 bits a lane, the disparity in bits 6..0, bit 7 = defined; 0 if undefined or outside the row.
  /// user = first beat of the frame, last = last beat of a row, keep = strb = the lanes inside the row.
  using disparity_beat = ap_axiu<lanes * 8, 1, 0, 0>;

  using width_t = ap_uint<window::bits_for(Config::max_width)>;
  using height_t = ap_uint<window::bits_for(Config::max_height)>;
  using levels_t = ap_uint<window::bits_for(Config::levels)>;
};

/// Which lanes of the beat that starts in column x lie in the frame's columns; none unless `beat_in`.
template <int Lanes, class Column, class Width>
void lanes_inside(Column x, Width width, bool beat_in, bool (&inside)[Lanes]) {
  for (int lane = 0; lane < Lanes; ++lane) inside[lane] = beat_in && x + lane < width;
}

/// The output token of a beat.
template <class Config>
typename stereo_interface<Config>::disparity_beat output_beat(
    const kernels::disparity_beat_of<Config::pixels_per_beat>& found) {
  typename stereo_interface<Config>::disparity_beat out;
  out.data = 0;
  for (int lane = 0; lane < Config::pixels_per_beat; ++lane) {
    const kernels::disparity_pixel pixel = found.pixel[lane];
    const ap_uint<8> value = (ap_uint<8>(1) << 7) | pixel.disparity;
    if (pixel.defined) out.data.range(8 * lane + 7, 8 * lane) = value;
    out.keep[lane] = pixel.in_frame;
  }
  out.strb = out.keep;
  out.user = found.marks.first_beat;
  out.last = found.marks.last_of_row;
  return out;
}

}  // namespace epiline::tops
