#pragma once
// Method 2, dense: colour SAD 7x7, winner take all, confidence, fuzzy inference. The whole method is one pixel loop.
#include <ap_int.h>
#include <hls_stream.h>

#include "kernels/candidates.hpp"
#include "kernels/color_sad.hpp"
#include "kernels/disparity.hpp"
#include "kernels/fuzzy_filter.hpp"
#include "kernels/fuzzy_rule_base.hpp"
#include "kernels/left_right_check.hpp"
#include "kernels/level_groups.hpp"
#include "kernels/uniqueness.hpp"
#include "kernels/winner.hpp"
#include "tops/stereo_interface.hpp"
#include "window/bits.hpp"
#include "window/line_buffer.hpp"
#include "window/raster.hpp"

namespace epiline::tops {

/// The reference configuration; others inherit it and hide what differs.
struct color_fuzzy_config {
  static constexpr int max_width = 1024;
  static constexpr int max_height = 4095;
  static constexpr int levels = 80;                                 // at most 128
  static constexpr int parallel_disparities = kernels::all_levels;  // computed in one clock; a divisor of levels
  static constexpr int pixels_per_beat = 1;
  static constexpr int window_radius = 3;
  static constexpr int fuzzy_radius = 3;
  static constexpr window::row_memory row_memory = window::row_memory::side_by_side;
  static constexpr int uniqueness_delay = 32;  // iterations the costs wait for the winner; see uniqueness_check
  using rule_base = kernels::triangular_rule_base<6>;
};

/// The types of a configuration's interface and its constants of time.
template <class Config>
struct color_fuzzy_interface : stereo_interface<Config> {
  /// How the raster walks over a frame.
  struct schedule : stereo_schedule<Config> {
    static constexpr int padding_beats = kernels::color_sad<Config>::delay_beats;
    static constexpr int padding_rows = Config::window_radius;
    static constexpr int flush_beats = kernels::uniqueness_check<Config>::delay_beats +
                                       kernels::left_right_check<Config>::delay_beats +
                                       2 * kernels::fuzzy_filter<Config>::delay_beats;
  };
  static_assert(schedule::padding_beats * Config::pixels_per_beat >= Config::fuzzy_radius,
                "rows lie too close for the fuzzy filter");
  static_assert(schedule::flush_beats >= schedule::minimum_row_beats, "the flush is a row, too");
};

/// One frame of method 2. Preconditions: width 1 .. max_width, height 1 .. max_height, levels 1 .. Config::levels.
/// `uniqueness` is in sixteenths (0 = off), `fuzzy` the number of passes (more than 2 count as 2).
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
  using frame_raster = window::raster<schedule>;
  using sad = color_sad<Config>;
  constexpr int lanes = Config::pixels_per_beat;

  // State lives on from frame to frame: calls follow one another without a bubble. A frame writes it before it reads
  // it, so it needs no reset, which would cost wires all over the device.
  static sad matcher;
  static best_of_groups<Config, typename sad::cost_t> best;
  static uniqueness_check<Config> unique;
  static left_right_check<Config> agreement;
  static fuzzy_filter<Config> first_pass;
  static fuzzy_filter<Config> second_pass;
  static_assert(sad::restarts, "windows of one row need a reset");
#pragma HLS RESET variable = matcher off
#pragma HLS RESET variable = best off
#pragma HLS RESET variable = unique off
#pragma HLS RESET variable = agreement off
#pragma HLS RESET variable = first_pass off
#pragma HLS RESET variable = second_pass off

  const typename frame_raster::beats_t beats = (width + (lanes - 1)) / lanes;
  frame_raster raster(beats, height);
  level_group<Config> group;
  // What stands in the delay lines at power-up must not reach the output: nothing is written before they have been
  // filled.
  window::warm_up<schedule::flush_beats> until_filled;
  bool more = true;
  do {
#pragma HLS PIPELINE II = 1
    typename sad::beat_t left_pixels = 0;
    typename sad::beat_t right_pixels = 0;
    if (group.first() && raster.in_frame()) {
      left_pixels = left.read().data;
      right_pixels = right.read().data;
    }

    typename sad::place at;
    at.column.beat = raster.beat();
    at.column.in_columns = raster.in_columns();
    lanes_inside(raster.beat() * lanes, width, !raster.in_flush(), at.column.lane_in);
    at.column.first_row = raster.row() == 0;
    at.row_starts = raster.beat() == 0;
    at.row_can_leave = raster.row() >= sad::window_rows;
    at.group = group;
    const auto all_costs = matcher.step(left_pixels, right_pixels, at);

    // The pixel the costs belong to lies half a window above and left of the newest one.
    const bool centre_in_rows = raster.row() >= schedule::padding_rows && !raster.in_flush();
    const bool centre_started = raster.beat() >= schedule::padding_beats;
    const typename frame_raster::beat_t centre_beat = raster.beat() - schedule::padding_beats;
    const ap_uint<window::bits_for(frame_raster::longest_row * lanes)> centre_x = centre_beat * lanes;
    bool pixel_in[lanes];
    lanes_inside(centre_x, width, centre_in_rows && centre_started, pixel_in);
    const auto costs =
        candidate_mask<Config, typename sad::costs, sad::penalty>::step(all_costs, centre_x, pixel_in, levels, group);

    disparity_beat_of<lanes> found;
    typename sad::cost_t lowest[lanes];
    pick_winners(costs, pixel_in, found.pixel, lowest);
    best.step(found.pixel, lowest, group);
    found.marks.in_frame = pixel_in[0];
    found.marks.first_beat = raster.row() == schedule::padding_rows && centre_beat == 0;
    found.marks.last_of_row = centre_beat == beats - 1;

    const auto confident = unique.step(costs, found, lowest, uniqueness, group);
    const auto agreed = agreement.step(confident.costs, confident.found, left_right, group);
    // From here on nothing depends on the level: one step a beat.
    if (group.last()) {
      const auto once = first_pass.step(agreed, fuzzy >= 1, careful_fill);
      const auto twice = second_pass.step(once, fuzzy >= 2, careful_fill);
      const bool filled = until_filled.step();
      if (filled && twice.marks.in_frame) disparity.write(output_beat<Config>(twice));
      more = raster.advance();
    }
    group.advance();
  } while (more);
}

}  // namespace epiline::tops
