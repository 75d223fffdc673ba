#include "csim/frame_beats.hpp"

#include <fmt/format.h>

namespace epiline::csim {
namespace {

std::uint32_t read_lane(const beat& token, unsigned lane, unsigned lane_bits) {
  const unsigned low = lane * lane_bits;
  std::uint64_t bits = token.data[low / 32] >> (low % 32);
  if (low % 32 + lane_bits > 32) bits |= std::uint64_t{token.data[low / 32 + 1]} << (32 - low % 32);
  return static_cast<std::uint32_t>(bits & ((std::uint64_t{1} << lane_bits) - 1));
}

void write_lane(beat& token, unsigned lane, unsigned lane_bits, std::uint32_t value) {
  const unsigned low = lane * lane_bits;
  const std::uint64_t bits = std::uint64_t{value} << (low % 32);
  token.data[low / 32] |= static_cast<std::uint32_t>(bits);
  if (low % 32 + lane_bits > 32) token.data[low / 32 + 1] |= static_cast<std::uint32_t>(bits >> 32);
}

}  // namespace

std::uint32_t keep_bits(int width, unsigned beat_in_row, int pixels_per_beat, unsigned lane_bits) {
  const unsigned first = beat_in_row * static_cast<unsigned>(pixels_per_beat);
  const unsigned lanes = std::min(static_cast<unsigned>(pixels_per_beat), static_cast<unsigned>(width) - first);
  return (std::uint32_t{1} << (lanes * lane_bits / 8)) - 1;
}

std::vector<beat> beats_of_image(const eval::rgb_image& image, int pixels_per_beat) {
  const unsigned row_beats = beats_a_row(image.width, pixels_per_beat);
  std::vector<beat> beats;
  beats.reserve(std::size_t{row_beats} * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (unsigned b = 0; b < row_beats; ++b) {
      beat token;
      token.keep = keep_bits(image.width, b, pixels_per_beat, input_lane_bits);
      token.user = y == 0 && b == 0 ? 1 : 0;
      token.last = b + 1 == row_beats;
      for (int lane = 0; lane < pixels_per_beat; ++lane) {
        const int x = static_cast<int>(b) * pixels_per_beat + lane;
        if (x >= image.width) break;
        const std::uint8_t* pixel = image.at(x, y);
        write_lane(token, static_cast<unsigned>(lane), input_lane_bits,
                   pixel[0] | std::uint32_t{pixel[1]} << 8 | std::uint32_t{pixel[2]} << 16);
      }
      beats.push_back(token);
    }
  }
  return beats;
}

eval::disparity_map map_of_beats(const std::vector<beat>& beats, int width, int height, int pixels_per_beat) {
  const unsigned row_beats = beats_a_row(width, pixels_per_beat);
  const std::size_t expected = std::size_t{row_beats} * static_cast<std::size_t>(height);
  if (beats.size() != expected) {
    throw malformed_frame(fmt::format("the disparity stream holds {} beats, a {}x{} frame has {}", beats.size(), width,
                                      height, expected));
  }
  eval::disparity_map map(width, height);
  for (std::size_t i = 0; i < beats.size(); ++i) {
    const beat& token = beats[i];
    const unsigned b = static_cast<unsigned>(i % row_beats);
    const int y = static_cast<int>(i / row_beats);
    const auto require = [&](std::string_view signal, std::uint32_t value, std::uint32_t wanted) {
      if (value == wanted) return;
      throw malformed_frame(
          fmt::format("beat {} of the disparity stream (row {}, beat {} of the row): {} is {:#x}, not {:#x}", i, y, b,
                      signal, value, wanted));
    };
    require("tuser", token.user, i == 0 ? 1 : 0);
    require("tlast", token.last ? 1 : 0, b + 1 == row_beats ? 1 : 0);
    require("tkeep", token.keep, keep_bits(width, b, pixels_per_beat, disparity_lane_bits));
    for (int lane = 0; lane < pixels_per_beat; ++lane) {
      const int x = static_cast<int>(b) * pixels_per_beat + lane;
      const std::uint32_t value = read_lane(token, static_cast<unsigned>(lane), disparity_lane_bits);
      if (x >= width) {
        require(fmt::format("lane {} past the end of the row", lane), value, 0);
        continue;
      }
      const bool defined = (value & 0x80) != 0;
      if (!defined) require(fmt::format("the disparity of undefined lane {}", lane), value, 0);
      map.disparity[map.index(x, y)] = static_cast<std::uint8_t>(value & 0x7f);
      map.defined[map.index(x, y)] = defined ? 1 : 0;
    }
  }
  return map;
}

}  // namespace epiline::csim
