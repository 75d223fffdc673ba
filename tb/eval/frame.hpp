#pragma once
// The two kinds of picture every engine speaks: an 8-bit colour input and a disparity map.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace epiline::eval {

/// 8-bit R, G, B in raster order, interleaved: pixel (x, y) starts at byte 3 * (y * width + x) with red.
struct rgb_image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  rgb_image() = default;
  rgb_image(int columns, int rows) : width(columns), height(rows), pixels(std::size_t{3} * columns * rows) {}

  [[nodiscard]] std::uint8_t* at(int x, int y) { return &pixels[3 * (static_cast<std::size_t>(y) * width + x)]; }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const {
    return &pixels[3 * (static_cast<std::size_t>(y) * width + x)];
  }
};

/// A disparity and a valid bit for every pixel, in raster order. The disparity of an undefined pixel is 0, so that two
/// maps are equal exactly when they mean the same.
struct disparity_map {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> disparity;
  std::vector<std::uint8_t> defined;  // 0 or 1

  disparity_map() = default;
  disparity_map(int columns, int rows)
      : width(columns),
        height(rows),
        disparity(static_cast<std::size_t>(columns) * rows),
        defined(static_cast<std::size_t>(columns) * rows) {}

  [[nodiscard]] std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
  [[nodiscard]] bool operator==(const disparity_map&) const = default;
};

}  // namespace epiline::eval
