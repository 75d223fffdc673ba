#pragma once
// The USB chip's end of the serial line in simulation: bytes to levels and back, clock by clock, and what may go wrong
// on the way.

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

namespace epiline::board {

/// Bytes to levels: start bit 0, eight bits from the lowest, stop bit 1. Clocks a bit need not be whole.
class line_driver {
 public:
  explicit line_driver(double clocks_a_bit) : clocks_a_bit_(clocks_a_bit) {}
  [[nodiscard]] bool idle() const { return bit_ == bits_of_byte; }
  void send(std::uint8_t byte) {
    levels_ = static_cast<std::uint16_t>(0x200 | byte << 1);
    bit_ = 0;
    left_ += clocks_a_bit_;
  }
  /// The level of the next clock.
  [[nodiscard]] bool step() {
    if (idle()) return true;
    const bool level = (levels_ >> bit_ & 1) != 0;
    left_ -= 1;
    if (left_ < 1) {
      ++bit_;
      if (!idle()) left_ += clocks_a_bit_;
    }
    return level;
  }

 private:
  static constexpr int bits_of_byte = 10;
  double clocks_a_bit_;
  double left_ = 0;
  std::uint16_t levels_ = 0;
  int bit_ = bits_of_byte;
};

/// Levels to bytes.
class line_listener {
 public:
  explicit line_listener(double clocks_a_bit) : clocks_a_bit_(clocks_a_bit) {}
  [[nodiscard]] bool idle() const { return bit_ < 0; }
  /// The level of this clock; the byte that it ends, if it does.
  [[nodiscard]] std::optional<std::uint8_t> step(bool level) {
    if (bit_ < 0) {
      if (last_ && !level) {
        bit_ = 0;
        left_ = 1.5 * clocks_a_bit_;  // the middle of the first data bit
        byte_ = 0;
      }
      last_ = level;
      return std::nullopt;
    }
    last_ = level;
    left_ -= 1;
    if (left_ >= 1) return std::nullopt;
    left_ += clocks_a_bit_;
    if (bit_ == 8) {
      bit_ = -1;
      return level ? std::optional(byte_) : std::nullopt;
    }
    byte_ = static_cast<std::uint8_t>(byte_ | level << bit_++);
    return std::nullopt;
  }

 private:
  double clocks_a_bit_;
  double left_ = 0;
  int bit_ = -1;
  bool last_ = true;
  std::uint8_t byte_ = 0;
};

/// Chances of a byte, each on its own.
struct line_faults {
  double drop = 0;
  double flip = 0;
  double duplicate = 0;
};

struct fault_counts {
  std::uint64_t bytes = 0;
  std::uint64_t dropped = 0;
  std::uint64_t flipped = 0;
  std::uint64_t duplicated = 0;
};

/// A queue of bytes in which some are lost, changed in one bit, or doubled.
class faulty_queue {
 public:
  faulty_queue(const line_faults& faults, std::uint64_t seed) : faults_(faults), random_(seed) {}

  void put(std::uint8_t byte) {
    ++counts_.bytes;
    if (happens(faults_.drop)) {
      ++counts_.dropped;
      return;
    }
    if (happens(faults_.flip)) {
      ++counts_.flipped;
      byte = static_cast<std::uint8_t>(byte ^ 1u << random_() % 8);
    }
    bytes_.push_back(byte);
    if (happens(faults_.duplicate)) {
      ++counts_.duplicated;
      bytes_.push_back(byte);
    }
  }
  [[nodiscard]] std::deque<std::uint8_t>& bytes() { return bytes_; }
  [[nodiscard]] const fault_counts& counts() const { return counts_; }

 private:
  [[nodiscard]] bool happens(double chance) {
    return chance > 0 && std::uniform_real_distribution<double>()(random_) < chance;
  }

  line_faults faults_;
  std::mt19937_64 random_;
  std::deque<std::uint8_t> bytes_;
  fault_counts counts_;
};

}  // namespace epiline::board
