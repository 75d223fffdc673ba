#pragma once
// Method 1, semi-dense: local variation, adaptive SAD, winner take all, cellular automaton. The whole method is one
// pixel loop.
#include <ap_int.h>
#include <hls_stream.h>

#include "kernels/adaptive_sad.hpp"
#include "kernels/ca_filter.hpp"
#include "kernels/candidates.hpp"
#include "kernels/disparity.hpp"
#include "kernels/level_groups.hpp"
#include "kernels/local_variation.hpp"
#include "kernels/luma.hpp"
#include "kernels/winner.hpp"
#include "tops/stereo_interface.hpp"
#include "window/bits.hpp"
#include "window/raster.hpp"
#include "window/window.hpp"

namespace epiline::tops {

/// The reference configuration; others inherit it and hide what differs.
struct adaptive_ca_config {
  static constexpr int max_width = 1024;
  static constexpr int max_height = 4095;
  static constexpr int levels = 80;                                 // at most 128
  static constexpr int parallel_disparities = kernels::all_levels;  // computed in one clock; a divisor of levels
  static constexpr int pixels_per_beat = 1;
};

/// The types of a configuration's interface and its constants of time.
template <class Config>
struct adaptive_ca_interface : stereo_interface<Config> {
  /// How the raster walks over a frame: the windows of the matcher and of the automaton's two rules lie one behind the
  /// other, the columns between two rows serve them all.
  struct schedule : stereo_schedule<Config> {
    static constexpr int padding_beats =
        window::divide_up(kernels::adaptive_sad<Config>::delay_columns, Config::pixels_per_beat);
    static constexpr int padding_rows =
        kernels::adaptive_sad<Config>::window_radius + kernels::ca_filter<Config>::delay_rows;
    static constexpr int flush_beats =
        window::larger(kernels::ca_filter<Config>::delay_beats, stereo_schedule<Config>::minimum_row_beats);
  };
  using t2_t = ap_uint<8>;
  using t5_t = ap_uint<12>;
  using ring_t = ap_uint<6>;
};

/// One frame of method 1. Preconditions: width 1 .. max_width, height 1 .. max_height, levels 1 .. Config::levels.
/// `t2` and `t5` are the thresholds of the local variation, `ring` (1 .. 40) that of the automaton's second rule;
/// without the automaton every pixel keeps its winner.
template <class Config>
void adaptive_ca_frame(hls::stream<typename adaptive_ca_interface<Config>::video_beat>& left,
                       hls::stream<typename adaptive_ca_interface<Config>::video_beat>& right,
                       hls::stream<typename adaptive_ca_interface<Config>::disparity_beat>& disparity,
                       typename adaptive_ca_interface<Config>::width_t width,
                       typename adaptive_ca_interface<Config>::height_t height,
                       typename adaptive_ca_interface<Config>::levels_t levels,
                       typename adaptive_ca_interface<Config>::t2_t t2, typename adaptive_ca_interface<Config>::t5_t t5,
                       ap_uint<1> automaton, typename adaptive_ca_interface<Config>::ring_t ring) {
#pragma HLS INLINE
  using namespace kernels;
  using types = adaptive_ca_interface<Config>;
  using schedule = typename types::schedule;
  using frame_raster = window::raster<schedule>;
  using sad = adaptive_sad<Config>;
  using rows = luma_rows<Config, sad::window_rows>;
  using variation_t = local_variation<Config, sad::delay_columns - Config::pixels_per_beat>;
  using filter_t = ca_filter<Config>;
  constexpr int lanes = Config::pixels_per_beat;
  constexpr int radius = sad::window_radius;

  // State lives on from frame to frame: calls follow one another without a bubble. A frame writes it before it reads
  // it, so it needs no reset, which would cost wires all over the device.
  static rows lines;
  static typename rows::columns columns;
  static variation_t variation;
  static window_choice_t choice[lanes];
  static window_choice_t choice_a_beat_ago[lanes];
  static sad matcher;
  static best_of_groups<Config, typename sad::cost_t> best;
  static window::row_window<disparity_pixel, lanes, schedule::padding_beats * lanes - sad::delay_columns + lanes>
      winners;
  static filter_t filter;
#pragma HLS RESET variable = lines off
#pragma HLS RESET variable = columns off
#pragma HLS RESET variable = variation off
#pragma HLS RESET variable = choice off
#pragma HLS RESET variable = choice_a_beat_ago off
#pragma HLS RESET variable = matcher off
#pragma HLS RESET variable = best off
#pragma HLS RESET variable = winners off
#pragma HLS RESET variable = filter off

  const typename frame_raster::beats_t beats = (width + (lanes - 1)) / lanes;
  frame_raster raster(beats, height);
  level_group<Config> group;
  // What stands in the delay lines at power-up must not reach the output: nothing is written before they have been
  // filled.
  window::warm_up<schedule::flush_beats> until_filled;
  bool more = true;
  do {
#pragma HLS PIPELINE II = 1
    if (group.first()) {
      typename rows::beat_t left_pixels = 0;
      typename rows::beat_t right_pixels = 0;
      if (raster.in_frame()) {
        left_pixels = left.read().data;
        right_pixels = right.read().data;
      }
      columns = lines.step(left_pixels, right_pixels, raster.beat(), raster.in_columns());
    }

    typename sad::place at;
    at.column.beat = raster.beat();
    at.column.in_columns = raster.in_columns();
    lanes_inside(raster.beat() * lanes, width, !raster.in_flush(), at.column.lane_in);
    at.column.first_row = raster.row() == 0;
    at.row_starts = raster.beat() == 0;
    for (int k = 0; k < sad::window_rows; ++k) at.row_in[k] = raster.row() >= k;
    at.group = group;

    // The five rows around the centre, which is `radius` rows above the newest one.
    luma_t around[variation_t::rows][lanes];
    typename variation_t::place variation_at;
    for (int row = 0; row < variation_t::rows; ++row) {
      const int above = radius + variation_t::rows / 2 - row;
      for (int lane = 0; lane < lanes; ++lane) around[row][lane] = columns.left[above][lane];
      variation_at.row_in[row] = raster.row() >= above && raster.row() < height + above;
    }
    for (int lane = 0; lane < lanes; ++lane) variation_at.lane_in[lane] = at.column.lane_in[lane];
    variation_at.row_starts = at.row_starts;
    if (group.first()) {
      variation.step(around, variation_at);
      for (int lane = 0; lane < lanes; ++lane) {
        choice[lane] = choice_a_beat_ago[lane];
        choice_a_beat_ago[lane] = variation.choice(lane, t2, t5);
      }
    }

    const auto all_costs = matcher.step(columns.left, columns.right, at, choice);

    // The pixels the costs belong to lie half a window above and further left.
    const bool centre_in_rows = raster.row() >= radius && raster.row() < height + radius && !raster.in_flush();
    const ap_int<window::bits_for(frame_raster::longest_row * lanes) + 1> centre_x =
        raster.beat() * lanes - sad::delay_columns;
    bool centre_in[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      centre_in[lane] = centre_in_rows && centre_x + lane >= 0 && centre_x + lane < width;
    }
    const auto costs =
        candidate_mask<Config, typename sad::costs, sad::penalty>::step(all_costs, centre_x, centre_in, levels, group);

    disparity_pixel centre_winner[lanes];
    typename sad::cost_t lowest[lanes];
    pick_winners(costs, centre_in, centre_winner, lowest);
    best.step(centre_winner, lowest, group);

    // From here on nothing depends on the level: one step a beat. The winners make whole beats again here, where they
    // are narrow.
    if (group.last()) winners.step(centre_winner, false);
    disparity_pixel winner[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      winner[lane] = winners.tap[schedule::padding_beats * lanes - sad::delay_columns + lanes - 1 - lane];
    }
    const bool centre_started = raster.beat() >= schedule::padding_beats;
    const typename frame_raster::beat_t centre_beat = raster.beat() - schedule::padding_beats;
    const ap_uint<window::bits_for(frame_raster::longest_row * lanes)> beat_x = centre_beat * lanes;
    bool column_in[lanes];
    lanes_inside(beat_x, width, centre_started && !raster.in_flush(), column_in);

    // The automaton's result lies further above; what its beat means is known here already.
    typename filter_t::place filter_at;
    filter_at.beat = centre_beat;
    filter_at.in_columns = column_in[0];
    const bool result_in_rows = raster.row() >= schedule::padding_rows;
    for (int lane = 0; lane < lanes; ++lane) filter_at.in_frame[lane] = result_in_rows && column_in[lane];
    filter_at.marks.in_frame = filter_at.in_frame[0];
    filter_at.marks.first_beat = raster.row() == schedule::padding_rows && centre_beat == 0;
    filter_at.marks.last_of_row = centre_beat == beats - 1;
    if (group.last()) {
      const auto found = filter.step(winner, filter_at, automaton, ring);
      const bool filled = until_filled.step();
      if (filled && found.marks.in_frame) disparity.write(output_beat<Config>(found));
      more = raster.advance();
    }
    group.advance();
  } while (more);
}

}  // namespace epiline::tops
