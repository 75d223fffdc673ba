// Method 2 with several clocks a pixel. LEVELS, PARALLEL_DISPARITIES: of the configuration.
#include "tops/color_fuzzy.hpp"

namespace {
struct config : epiline::tops::color_fuzzy_config {
  static constexpr int levels = LEVELS;
  static constexpr int parallel_disparities = PARALLEL_DISPARITIES;
};
using types = epiline::tops::color_fuzzy_interface<config>;
}  // namespace

void color_fuzzy_groups(hls::stream<types::video_beat>& left, hls::stream<types::video_beat>& right,
                        hls::stream<types::disparity_beat>& disparity, types::width_t width, types::height_t height,
                        types::levels_t levels, ap_uint<1> left_right, ap_uint<5> uniqueness, ap_uint<2> fuzzy,
                        ap_uint<1> careful_fill) {
  epiline::tops::color_fuzzy_frame<config>(left, right, disparity, width, height, levels, left_right, uniqueness, fuzzy,
                                           careful_fill);
}
