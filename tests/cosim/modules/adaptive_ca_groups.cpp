// Method 1 with several clocks a pixel. LEVELS, PARALLEL_DISPARITIES: of the configuration.
#include "tops/adaptive_ca.hpp"

namespace {
struct config : epiline::tops::adaptive_ca_config {
  static constexpr int levels = LEVELS;
  static constexpr int parallel_disparities = PARALLEL_DISPARITIES;
};
using types = epiline::tops::adaptive_ca_interface<config>;
}  // namespace

void adaptive_ca_groups(hls::stream<types::video_beat>& left, hls::stream<types::video_beat>& right,
                        hls::stream<types::disparity_beat>& disparity, types::width_t width, types::height_t height,
                        types::levels_t levels, types::t2_t t2, types::t5_t t5, ap_uint<1> automaton,
                        types::ring_t ring) {
  epiline::tops::adaptive_ca_frame<config>(left, right, disparity, width, height, levels, t2, t5, automaton, ring);
}
