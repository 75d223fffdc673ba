#pragma once
// Small synthetic stereo pairs on which every step of a matcher has something to decide.

#include <algorithm>
#include <random>

#include "eval/frame.hpp"

namespace epiline::test {

struct image_pair {
  eval::rgb_image left;
  eval::rgb_image right;
};

/// The right image is the left one shifted by a disparity that changes now and then, with noise. `greys` is the number
/// of values a colour takes: few of them make many ties.
inline image_pair random_pair(std::mt19937& random, int width, int height, int largest_shift, int greys) {
  image_pair pair{{width, height}, {width, height}};
  const auto below = [&](int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); };
  const int step = 255 / std::max(greys - 1, 1);
  for (auto& value : pair.left.pixels) value = static_cast<std::uint8_t>(below(greys) * step);
  int shift = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (below(8) == 0) shift = below(largest_shift + 1);
      for (int c = 0; c < 3; ++c) {
        const int seen = x + shift < width ? pair.left.at(x + shift, y)[c] : below(256);
        pair.right.at(x, y)[c] = static_cast<std::uint8_t>(std::clamp(seen + below(9) - 4, 0, 255));
      }
    }
  }
  return pair;
}

}  // namespace epiline::test
