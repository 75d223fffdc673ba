#pragma once
// Method 2, dense: colour SAD 7x7, winner take all, confidence, fuzzy inference. The whole method is one pixel loop.
#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <hls_stream.h>

#include "kernels/candidates.hpp"
#include "kernels/color_sad.hpp"
#include "kernels/disparity.hpp"
#include "window/bits.hpp"
#include "window/raster.hpp"
#include "window/reduce.hpp"

namespace epiline::tops {

/// The reference configuration; others inherit it and hide what differs.
struct color_fuzzy_config {
  static constexpr int max_width = 1024;
  static constexpr int max_height = 4095;
  static constexpr int levels = 80;  // at most 128
  static constexpr int pixels_per_beat = 1;
  static constexpr int window_radius = 3;
};

/// The types of a configuration's interface and its constants of time.
template <class Config>
struct color_fuzzy_interface {
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

  /// How the raster walks over a frame.
  struct schedule {
    static constexpr int maximum_beats = window::divide_up(Config::max_width, lanes);
    static constexpr int maximum_rows = Config::max_height;
    static constexpr int padding_beats = kernels::color_sad<Config>::delay_beats;
    static constexpr int padding_rows = Config::window_radius;
    static constexpr int flush_beats = 8;
    static constexpr int minimum_row_beats = 8;  // what line_buffer and column_sum promise
  };
};

template <class Config>
void color_fuzzy_frame(hls::stream<typename color_fuzzy_interface<Config>::video_beat>& left,
                       hls::stream<typename color_fuzzy_interface<Config>::video_beat>& right,
                       hls::stream<typename color_fuzzy_interface<Config>::disparity_beat>& disparity,
                       typename color_fuzzy_interface<Config>::width_t width,
                       typename color_fuzzy_interface<Config>::height_t height,
                       typename color_fuzzy_interface<Config>::levels_t levels, ap_uint<1> left_right,
                       ap_uint<5> uniqueness, ap_uint<2> fuzzy, ap_uint<1> careful_fill) {
#pragma HLS INLINE
  using namespace kernels;
  using types = color_fuzzy_interface<Config>;
  using schedule = typename types::schedule;
  using sad = color_sad<Config>;
  constexpr int lanes = Config::pixels_per_beat;

  (void)left_right, (void)uniqueness, (void)fuzzy, (void)careful_fill;  // steps to come

  static sad matcher;

  const typename window::raster<schedule>::beats_t beats = (width + (lanes - 1)) / lanes;
  window::raster<schedule> raster(beats, height);
  bool more = true;
  do {
#pragma HLS PIPELINE II = 1
    typename sad::beat_t left_pixels = 0;
    typename sad::beat_t right_pixels = 0;
    if (raster.in_frame()) {
      left_pixels = left.read().data;
      right_pixels = right.read().data;
    }

    typename sad::place at;
    at.column.beat = raster.beat();
    at.column.in_columns = raster.in_columns();
    for (int lane = 0; lane < lanes; ++lane) {
      at.column.lane_in[lane] = raster.beat() * lanes + lane < width && !raster.in_flush();
    }
    at.column.first_row = raster.row() == 0;
    at.row_starts = raster.beat() == 0;
    at.row_can_leave = raster.row() >= sad::window_rows;
    const auto all_costs = matcher.step(left_pixels, right_pixels, at);

    // The pixel the costs belong to lies half a window above and left of the newest one.
    const bool centre_in_rows = raster.row() >= schedule::padding_rows && !raster.in_flush();
    const bool centre_started = raster.beat() >= schedule::padding_beats;
    const typename window::raster<schedule>::beat_t centre_beat = raster.beat() - schedule::padding_beats;
    const ap_uint<13> centre_x = centre_beat * lanes;
    bool pixel_in[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      pixel_in[lane] = centre_in_rows && centre_started && centre_x + lane < width;
    }
    const auto costs = candidate_mask<Config, typename sad::costs>::step(all_costs, centre_x, pixel_in, levels);

    disparity_beat_of<lanes> found;
    for (int lane = 0; lane < lanes; ++lane) {
      const auto winner = window::minimum<window::smallest_index_wins>(costs.at[lane]);
      found.pixel[lane].disparity = winner.index;
      found.pixel[lane].defined = pixel_in[lane];
      found.pixel[lane].in_frame = pixel_in[lane];
    }
    found.marks.in_frame = pixel_in[0];
    found.marks.first_beat = raster.row() == schedule::padding_rows && centre_beat == 0;
    found.marks.last_of_row = centre_beat == beats - 1;

    if (found.marks.in_frame) {
      typename types::disparity_beat out;
      out.data = 0;
      out.keep = 0;
      for (int lane = 0; lane < lanes; ++lane) {
        const disparity_pixel pixel = found.pixel[lane];
        if (pixel.defined) out.data.range(8 * lane + 7, 8 * lane) = (ap_uint<8>(pixel.defined) << 7) | pixel.disparity;
        out.keep[lane] = pixel.in_frame;
      }
      out.strb = out.keep;
      out.user = found.marks.first_beat;
      out.last = found.marks.last_of_row;
      disparity.write(out);
    }
    more = raster.advance();
  } while (more);
}

}  // namespace epiline::tops
