// Method 1 for quick experiments with two pixels a beat: 8 levels, rows of up to 64 pixels.
#include "tops/adaptive_ca.hpp"

namespace {
using config = epiline::tops::two_pixels_a_beat_of<epiline::tops::few_levels_of<epiline::tops::adaptive_ca_config>>;
using types = epiline::tops::adaptive_ca_interface<config>;
}  // namespace

void adaptive_ca_small_p2(hls::stream<types::video_beat>& left, hls::stream<types::video_beat>& right,
                          hls::stream<types::disparity_beat>& disparity, types::width_t width, types::height_t height,
                          types::levels_t levels, types::t2_t t2, types::t5_t t5, ap_uint<1> automaton,
                          types::ring_t ring) {
  epiline::tops::adaptive_ca_frame<config>(left, right, disparity, width, height, levels, t2, t5, automaton, ring);
}
