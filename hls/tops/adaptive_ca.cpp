#include "tops/adaptive_ca.hpp"

using config = epiline::tops::adaptive_ca_config;
using types = epiline::tops::adaptive_ca_interface<config>;

void adaptive_ca(hls::stream<types::video_beat>& left, hls::stream<types::video_beat>& right,
                 hls::stream<types::disparity_beat>& disparity, types::width_t width, types::height_t height,
                 types::levels_t levels, types::t2_t t2, types::t5_t t5, ap_uint<1> automaton, types::ring_t ring) {
  epiline::tops::adaptive_ca_frame<config>(left, right, disparity, width, height, levels, t2, t5, automaton, ring);
}
