#pragma once
// The packets between host and board, as bytes: 0x7e, content, CRC-32 of the content with its low byte first, 0x7e.
// Inside, 0x7e is written 0x7d 0x5e and 0x7d is written 0x7d 0x5d, so that every 0x7e is a fresh start. boards/common
// has the other side; docs/board.md the tables.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace epiline::board {

using bytes = std::vector<std::uint8_t>;

enum class packet_kind : std::uint8_t {
  // to the board
  identify = 0x01,  // answered with identity
  start = 0x02,     // a session begins, unless it has already; answered with state, like what follows
  data = 0x03,      // place: the first byte's; payload: bytes for the design
  read = 0x04,      // place: the first byte wanted; payload: how many (2 bytes), bytes that the host has (4)
  status = 0x05,    // place: any number below 256, which the next state repeats
  // from the board
  identity = 0x81,  // payload: text
  result = 0x84,    // place: the first byte's; payload: bytes of the design. The answer to read if there are some
  state = 0x85,     // place: of the byte expected next; payload: see board_link.cpp
};

struct packet {
  packet_kind kind{};
  std::uint16_t session = 0;
  std::uint32_t place = 0;  // in the stream of bytes since the session began
  bytes payload;

  [[nodiscard]] bool operator==(const packet&) const = default;
};

/// The number of `count` bytes at `first`, the low one first; the bytes must be there.
[[nodiscard]] std::uint64_t little_endian(std::span<const std::uint8_t> from, std::size_t first, std::size_t count);
void append_little_endian(bytes& to, std::uint64_t value, std::size_t count);

[[nodiscard]] std::uint32_t crc32_of(std::span<const std::uint8_t> data, std::uint32_t crc_before = 0);

/// As it goes over the line.
[[nodiscard]] bytes encode(const packet& packet);

/// Finds packets among the bytes of a line, whatever was lost or changed.
class packet_decoder {
 public:
  /// The packet that ends with this byte, if one does and its CRC is right.
  [[nodiscard]] std::optional<packet> take(std::uint8_t byte);

  /// Packets, or what looked like it, that were wrong.
  [[nodiscard]] std::uint64_t bad_packets() const { return bad_packets_; }

 private:
  bytes content_;
  bool escaped_ = false;
  std::uint64_t bad_packets_ = 0;
};

}  // namespace epiline::board
