#pragma once
// Pictures of few colours as PNG with a palette, which no function of OpenCV writes.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace epiline::eval {

using rgb_colour = std::array<std::uint8_t, 3>;

struct indexed_picture {
  int width = 0;
  int height = 0;
  std::vector<rgb_colour> colours;   // 1 to 256
  std::vector<std::uint8_t> pixels;  // raster order, each an index into `colours`
};

/// `count` colours from far (blue) to near (red) at equal steps; count >= 2.
[[nodiscard]] std::vector<rgb_colour> disparity_colours(int count);

/// Throws std::invalid_argument when the picture has no pixels, no colours, or a pixel without a colour.
[[nodiscard]] std::string png_of(const indexed_picture& picture);

}  // namespace epiline::eval
