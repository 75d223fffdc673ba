#pragma once
// Frames as the beats of AXI4-Stream video, and back: the one place that knows how a picture is laid out in tokens.
// Used by every engine that feeds a top (native C++, dataflow graph, RTL, netlist).
//
// A row starts a new beat; lane 0 (the leftmost pixel) is in the low bits. tuser = 1 marks the first beat of a frame,
// tlast the last beat of a row; tkeep has one bit a byte, set where the lane holds a pixel of the row. Lanes past the
// end of a row are 0.

#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "eval/frame.hpp"

namespace epiline::csim {

inline constexpr unsigned input_lane_bits = 24;     // red in bits 7..0, green in 15..8, blue in 23..16
inline constexpr unsigned disparity_lane_bits = 8;  // the disparity in bits 6..0, bit 7 = defined

/// One token of a video stream as plain bits; word 0 of `data` holds bits 31..0.
struct beat {
  std::array<std::uint32_t, 4> data{};
  std::uint32_t keep = 0;
  std::uint32_t user = 0;
  bool last = false;

  [[nodiscard]] bool operator==(const beat&) const = default;
};

/// The output's beats are not a frame of the size asked for; what() says which beat and why.
class malformed_frame : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[nodiscard]] constexpr unsigned beats_a_row(int width, int pixels_per_beat) {
  return static_cast<unsigned>((width + pixels_per_beat - 1) / pixels_per_beat);
}

/// tkeep of beat number `beat_in_row`.
[[nodiscard]] std::uint32_t keep_bits(int width, unsigned beat_in_row, int pixels_per_beat, unsigned lane_bits);

/// `pixels_per_beat` is 1, 2 or 4.
[[nodiscard]] std::vector<beat> beats_of_image(const eval::rgb_image& image, int pixels_per_beat);

/// Throws malformed_frame when the number of beats, a tuser, a tlast or a tkeep is not that of a width x height frame.
[[nodiscard]] eval::disparity_map map_of_beats(const std::vector<beat>& beats, int width, int height,
                                               int pixels_per_beat);

}  // namespace epiline::csim
