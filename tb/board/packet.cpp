#include "board/packet.hpp"

#include <zlib.h>

namespace epiline::board {
namespace {

constexpr std::uint8_t flag = 0x7e;
constexpr std::uint8_t escape = 0x7d;
constexpr std::uint8_t escape_bit = 0x20;
constexpr std::size_t header_bytes = 7;
constexpr std::size_t crc_bytes = 4;
constexpr std::size_t longest_content = 4096;  // more is noise

void append_stuffed(bytes& line, std::uint8_t byte) {
  if (byte == flag || byte == escape) {
    line.push_back(escape);
    byte ^= escape_bit;
  }
  line.push_back(byte);
}

}  // namespace

std::uint64_t little_endian(std::span<const std::uint8_t> from, std::size_t first, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t{from[first + i]} << (8 * i);
  return value;
}

void append_little_endian(bytes& to, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint32_t crc32_of(std::span<const std::uint8_t> data, std::uint32_t crc_before) {
  return static_cast<std::uint32_t>(crc32_z(crc_before, data.data(), data.size()));
}

bytes encode(const packet& packet) {
  bytes content;
  content.push_back(static_cast<std::uint8_t>(packet.kind));
  append_little_endian(content, packet.session, 2);
  append_little_endian(content, packet.place, 4);
  content.insert(content.end(), packet.payload.begin(), packet.payload.end());
  append_little_endian(content, crc32_of(content), crc_bytes);
  bytes line{flag};
  for (const std::uint8_t byte : content) append_stuffed(line, byte);
  line.push_back(flag);
  return line;
}

std::optional<packet> packet_decoder::take(std::uint8_t byte) {
  if (byte == escape) {
    escaped_ = true;
    return std::nullopt;
  }
  if (byte != flag) {
    if (content_.size() < longest_content) content_.push_back(escaped_ ? byte ^ escape_bit : byte);
    escaped_ = false;
    return std::nullopt;
  }
  std::optional<packet> found;
  const std::span<const std::uint8_t> content(content_);
  if (!escaped_ && content.size() >= header_bytes + crc_bytes) {
    const auto body = content.first(content.size() - crc_bytes);
    if (crc32_of(body) == little_endian(content, body.size(), crc_bytes)) {
      found.emplace();
      found->kind = static_cast<packet_kind>(body[0]);
      found->session = static_cast<std::uint16_t>(little_endian(body, 1, 2));
      found->place = static_cast<std::uint32_t>(little_endian(body, 3, 4));
      found->payload.assign(body.begin() + header_bytes, body.end());
    }
  }
  if (!found && !content.empty()) ++bad_packets_;
  content_.clear();
  escaped_ = false;
  return found;
}

}  // namespace epiline::board
