// Packets: what is encoded is decoded, whatever bytes it holds; what was damaged is refused, and the next one is found.

#include "board/packet.hpp"

#include <gmock/gmock.h>

#include <random>

namespace epiline::board {
namespace {

using testing::ElementsAre;

std::vector<packet> decode(const bytes& line, packet_decoder& decoder) {
  std::vector<packet> found;
  for (const std::uint8_t byte : line) {
    if (auto packet = decoder.take(byte)) found.push_back(std::move(*packet));
  }
  return found;
}

packet random_packet(std::mt19937& random) {
  packet made{packet_kind::data, static_cast<std::uint16_t>(random()), static_cast<std::uint32_t>(random()), {}};
  made.payload.resize(random() % 200);
  for (auto& byte : made.payload) {
    byte = static_cast<std::uint8_t>(random() % 3 == 0 ? 0x7c + random() % 4 : random());
  }
  return made;
}

TEST(packet, has_the_layout_of_the_documentation) {
  EXPECT_THAT(encode({packet_kind::data, 0x7e01, 0x04030201, {0x7d}}),
              ElementsAre(0x7e, 0x03, 0x01, 0x7d, 0x5e, 0x01, 0x02, 0x03, 0x04, 0x7d, 0x5d, testing::_, testing::_,
                          testing::_, testing::_, 0x7e));
  EXPECT_EQ(crc32_of(bytes{'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0xcbf43926u);
}

TEST(packet, comes_back_whatever_it_holds) {
  std::mt19937 random(1);
  packet_decoder decoder;
  for (int i = 0; i < 500; ++i) {
    const packet sent = random_packet(random);
    EXPECT_THAT(decode(encode(sent), decoder), ElementsAre(sent));
  }
  EXPECT_EQ(decoder.bad_packets(), 0u);
}

TEST(packet, is_refused_if_damaged_and_the_next_one_is_found) {
  std::mt19937 random(2);
  packet_decoder decoder;
  for (int i = 0; i < 1000; ++i) {
    const packet sent = random_packet(random);
    bytes line = encode(sent);
    const auto at = line.begin() + 1 + static_cast<std::ptrdiff_t>(random() % (line.size() - 2));
    switch (i % 3) {
      case 0:
        line.erase(at);
        break;
      case 1:
        *at = static_cast<std::uint8_t>(*at ^ 1u << random() % 8);
        break;
      default:
        line.insert(at, *at);
        break;
    }
    for (const packet& found : decode(line, decoder)) EXPECT_EQ(found, sent);  // a doubled 0x7d is no damage
    EXPECT_THAT(decode(encode(sent), decoder), testing::Contains(sent));
  }
  EXPECT_GT(decoder.bad_packets(), 900u);
}

}  // namespace
}  // namespace epiline::board
