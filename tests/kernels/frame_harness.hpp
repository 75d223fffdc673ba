#pragma once
// Feeds a configuration of a method with pictures and collects its disparity map, checking every side signal.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "tops/adaptive_ca.hpp"
#include "tops/color_fuzzy.hpp"

namespace epiline::test {

struct picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> channels;  // red, green, blue of every pixel in raster order

  [[nodiscard]] int at(int x, int y, int channel) const {
    return channels[static_cast<std::size_t>((y * width + x) * 3 + channel)];
  }
};

struct stereo_pair {
  picture left;
  picture right;
};

struct settings {
  int levels = 80;
  bool left_right = true;
  int uniqueness = 17;
  int fuzzy = 2;
  bool careful_fill = false;
};

struct adaptive_ca_settings {
  int levels = 80;
  int t2 = 32;
  int t5 = 100;
  bool automaton = true;
  int ring = 24;
};

inline constexpr int undefined = 255;
/// One value a pixel in raster order: the disparity, or `undefined`.
using disparity_map = std::vector<int>;

/// The right picture is the left one shifted, with noise: so that every step of the method has something to decide.
inline stereo_pair random_pair(std::mt19937& random, int width, int height, int largest_shift, int noise) {
  stereo_pair pair{{width, height, {}}, {width, height, {}}};
  const auto count = static_cast<std::size_t>(width * height * 3);
  pair.left.channels.resize(count);
  pair.right.channels.resize(count);
  const int range = 1 + static_cast<int>(random() % 256);  // few grey values make many ties
  for (auto& value : pair.left.channels) value = static_cast<std::uint8_t>(random() % static_cast<unsigned>(range));
  int shift = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (random() % 8 == 0) shift = static_cast<int>(random() % static_cast<unsigned>(largest_shift + 1));
      for (int c = 0; c < 3; ++c) {
        int value = x + shift < width ? pair.left.at(x + shift, y, c) : static_cast<int>(random() % 256);
        if (noise > 0) value += static_cast<int>(random() % static_cast<unsigned>(noise)) - noise / 2;
        pair.right.channels[static_cast<std::size_t>((y * width + x) * 3 + c)] =
            static_cast<std::uint8_t>(value < 0 ? 0 : (value > 255 ? 255 : value));
      }
    }
  }
  return pair;
}

/// Calls `top(left, right, disparity)` on streams that hold the pair. Types: its interface.
template <class Types, class Top>
disparity_map run_frame(const stereo_pair& pair, Top top) {
  using types = Types;
  constexpr int lanes = types::lanes;
  hls::stream<typename types::video_beat> left("left");
  hls::stream<typename types::video_beat> right("right");
  hls::stream<typename types::disparity_beat> disparity("disparity");
  const int width = pair.left.width;
  const int height = pair.left.height;
  for (const auto& [image, stream] : {std::pair{&pair.left, &left}, std::pair{&pair.right, &right}}) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; x += lanes) {
        typename types::video_beat beat{};
        // Lanes past the end of a row and the side signals are noise: the top must not look at them.
        for (int lane = 0; lane < lanes; ++lane) {
          for (int c = 0; c < 3; ++c) {
            const int value = x + lane < width ? image->at(x + lane, y, c) : (x * 7 + y * 13 + lane * 31 + c) % 256;
            beat.data.range(24 * lane + 8 * c + 7, 24 * lane + 8 * c) = value;
          }
        }
        beat.user = (x + y) % 2;
        beat.last = x % 3 == 0;
        beat.keep = 0;
        beat.strb = 0;
        stream->write(beat);
      }
    }
  }
  top(left, right, disparity);
  EXPECT_TRUE(left.empty());
  EXPECT_TRUE(right.empty());
  disparity_map map;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; x += lanes) {
      if (disparity.empty()) {
        ADD_FAILURE() << "no beat for column " << x << " of row " << y;
        return map;
      }
      const auto beat = disparity.read();
      EXPECT_EQ(beat.user != 0, x == 0 && y == 0) << "column " << x << " of row " << y;
      EXPECT_EQ(beat.last != 0, x + lanes >= width) << "column " << x << " of row " << y;
      EXPECT_EQ(beat.keep, beat.strb);
      for (int lane = 0; lane < lanes; ++lane) {
        const int value = static_cast<int>(beat.data.range(8 * lane + 7, 8 * lane).to_uint());
        const bool exists = x + lane < width;
        EXPECT_EQ(static_cast<bool>(beat.keep[lane]), exists) << "column " << x + lane << " of row " << y;
        if (value < 128) {
          EXPECT_EQ(value, 0) << "undefined lanes are 0";
        }
        if (exists) map.push_back(value >= 128 ? value - 128 : undefined);
        if (!exists) {
          EXPECT_EQ(value, 0) << "lanes outside the row are 0";
        }
      }
    }
  }
  EXPECT_TRUE(disparity.empty());
  return map;
}

template <class Config>
disparity_map run_color_fuzzy(const stereo_pair& pair, const settings& with) {
  return run_frame<tops::color_fuzzy_interface<Config>>(pair, [&](auto& left, auto& right, auto& disparity) {
    tops::color_fuzzy_frame<Config>(left, right, disparity, pair.left.width, pair.left.height, with.levels,
                                    with.left_right, with.uniqueness, with.fuzzy, with.careful_fill);
  });
}

template <class Config>
disparity_map run_adaptive_ca(const stereo_pair& pair, const adaptive_ca_settings& with) {
  return run_frame<tops::adaptive_ca_interface<Config>>(pair, [&](auto& left, auto& right, auto& disparity) {
    tops::adaptive_ca_frame<Config>(left, right, disparity, pair.left.width, pair.left.height, with.levels, with.t2,
                                    with.t5, with.automaton, with.ring);
  });
}

}  // namespace epiline::test
