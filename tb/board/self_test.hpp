#pragma once
// The board's self-test at full speed: it generates frames itself, one after the other without a pause, and returns a
// CRC of all disparities and the clocks that took. Here the same frames are generated in software and matched natively.

#include <cstdint>
#include <functional>

#include "board/board_order.hpp"

namespace epiline::board {

/// boards/common/pixel_generator.v: x^64 + x^63 + x^61 + x^60 + 1, the newest bit lowest.
class pixel_sequence {
 public:
  explicit pixel_sequence(std::uint64_t state) : state_(state) {}
  [[nodiscard]] std::uint64_t state() const { return state_; }
  /// Moves on by that many bits.
  void advance(unsigned bits) {
    for (unsigned i = 0; i < bits; ++i) {
      state_ = state_ << 1 | ((state_ >> 63 ^ state_ >> 62 ^ state_ >> 60 ^ state_ >> 59) & 1);
    }
  }

 private:
  std::uint64_t state_;
};

/// Seeds for pictures with two disparities in turns of 32 beats, about a quarter and half of `levels`.
[[nodiscard]] generator_seeds seeds_of(std::uint64_t seed, int levels, int pixels_per_beat);

/// Generates the frames of a self-test, one after the other.
class self_test_frames {
 public:
  self_test_frames(const generator_seeds& seeds, int pixels_per_beat);
  /// Fills the two pictures, which have one size.
  void next(eval::rgb_image& left, eval::rgb_image& right);

 private:
  pixel_sequence left_near_, left_far_, right_;
  unsigned lanes_;
  std::uint64_t beat_ = 0;
};

/// CRC-32 of the disparities of `frames` frames as `engine` matches them. `request` has size, levels and parameters.
[[nodiscard]] std::uint32_t expected_crc(const board_identity& identity, eval::match_request request,
                                         std::uint32_t frames, const generator_seeds& seeds, eval::engine& engine,
                                         const std::function<void(double)>& progress = {});

/// Lets the board do the same. Throws link_error and port_error.
[[nodiscard]] self_test_report run_self_test(board_link& link, const board_identity& identity,
                                             const eval::match_request& request, std::uint32_t frames,
                                             const generator_seeds& seeds);

}  // namespace epiline::board
