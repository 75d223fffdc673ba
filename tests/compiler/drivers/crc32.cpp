#include "../drive.hpp"
namespace kernel_crc32 {
#include "../kernels/crc32.cpp"
}
using namespace kernel_crc32;

EPILINE_DRIVER(crc32) {
  auto& data = s.input<byte_t>("data");
  auto& checksum = s.output<ap_uint<32>>("checksum");
  std::vector<std::string> packets = {"123456789", "a"};
  for (const int length : {1, 2, 64, 255}) {
    packets.emplace_back();
    for (int i = 0; i < length; ++i) packets.back() += char(s.number(0, 255));
  }
  for (const std::string& packet : packets) {
    for (std::size_t i = 0; i < packet.size(); ++i) {
      byte_t beat = s.any<byte_t>();
      beat.data = static_cast<unsigned char>(packet[i]);
      beat.last = i + 1 == packet.size();
      data.push(beat);
    }
    crc32(data.stream, checksum.stream);
  }
  const auto found = checksum.drain();
  s.expect(found.size() == packets.size(), "one checksum a packet");
  s.expect(found[0] == 0xCBF43926u, "the check value of CRC-32");
  s.expect(found[1] == 0xE8B7BE43u, "the CRC-32 of \"a\"");
}
