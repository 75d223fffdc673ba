#include "../drive.hpp"
namespace kernel_huffman_decoder {
#include "../kernels/huffman_decoder.cpp"
}
using namespace kernel_huffman_decoder;
EPILINE_LEAVES(difference_t, v.category, v.value);

// Encodes differences with the standard's table of codes, written out, and expects them back.
EPILINE_DRIVER(huffman_decoder) {
  static const char* const codes[12] = {"00",   "010",   "011",    "100",     "101",      "110",
                                        "1110", "11110", "111110", "1111110", "11111110", "111111110"};
  auto& scan = s.input<byte_t>("scan");
  auto& differences = s.output<difference_t>("differences");
  std::vector<int> wanted;
  for (const int blocks : {30, 1, 0, 60}) {
    std::string bits;
    for (int block = 0; block < blocks; ++block) {
      const int size = int(s.number(0, 11));
      int value = size == 0 ? 0 : int(s.number(1 << (size - 1), (1 << size) - 1));
      if (s.chance(50)) value = -value;
      if (size == 11 && s.chance(50)) value = value < 0 ? -2047 : 2047;
      bits += codes[size];
      const int extra = value < 0 ? value + (1 << size) - 1 : value;
      for (int i = size - 1; i >= 0; --i) bits += extra >> i & 1 ? '1' : '0';
      wanted.push_back(size);
      wanted.push_back(value);
    }
    while (bits.size() % 8 != 0) bits += '1';  // F.1.2.3
    for (std::size_t i = 0; i < bits.size(); i += 8) {
      const int byte = std::stoi(bits.substr(i, 8), nullptr, 2);
      scan.push(byte);
      if (byte == 255) scan.push(0);
    }
    s.call({{"blocks", static_cast<unsigned short>(blocks)}});
    huffman_decoder(scan.stream, differences.stream, static_cast<unsigned short>(blocks));
  }
  std::vector<int> found;
  for (const difference_t& d : differences.drain()) {
    found.push_back(int(d.category));
    found.push_back(int(d.value));
  }
  s.expect_equal(found, wanted, "differences");
}
