#include "tops/color_fuzzy_hx8k.hpp"

using config = epiline::tops::color_fuzzy_hx8k_config;
using types = epiline::tops::color_fuzzy_interface<config>;

void color_fuzzy_hx8k(hls::stream<types::video_beat>& left, hls::stream<types::video_beat>& right,
                      hls::stream<types::disparity_beat>& disparity, types::width_t width, types::height_t height,
                      types::levels_t levels, ap_uint<1> left_right, ap_uint<5> uniqueness, ap_uint<2> fuzzy,
                      ap_uint<1> careful_fill) {
  epiline::tops::color_fuzzy_frame<config>(left, right, disparity, width, height, levels, left_right, uniqueness, fuzzy,
                                           careful_fill);
}
