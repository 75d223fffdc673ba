#pragma once
// Method 2 for a small and cheap FPGA, Lattice iCE40 HX8K.
#include "tops/color_fuzzy.hpp"

namespace epiline::tops {

/// 160x120 pixels, 16 levels, two of them in a clock: eight clocks a pixel.
struct color_fuzzy_hx8k_config : color_fuzzy_config {
  static constexpr int max_width = 160;
  static constexpr int max_height = 120;
  static constexpr int levels = 16;
  static constexpr int parallel_disparities = 2;
  static constexpr window::row_memory row_memory = window::row_memory::one_after_another;
};

}  // namespace epiline::tops
