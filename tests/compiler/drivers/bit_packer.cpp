#include "../drive.hpp"
namespace kernel_bit_packer {
#include "../kernels/bit_packer.cpp"
}
using namespace kernel_bit_packer;

EPILINE_LEAVES(code_t, v.bits, v.length);
EPILINE_DRIVER(bit_packer) {
  auto& codes = s.input<code_t>("codes");
  auto& words = s.output<ap_uint<16>>("words");
  std::vector<unsigned> wanted;
  std::string stream;
  for (int i = 0; i < 300; ++i) {
    code_t c = s.any<code_t>();
    c.length = i == 299 || s.chance(5) ? 15 : int(s.number(0, 12));
    codes.push(c);
    bit_packer(codes.stream, words.stream);
    const bool flush = c.length == 15;
    for (int b = flush ? -1 : int(c.length) - 1; b >= 0; --b) stream += c.bits[b] ? '1' : '0';
    if (flush) stream.resize((stream.size() + 15) / 16 * 16, '0');
    for (; stream.size() >= 16; stream.erase(0, 16))
      wanted.push_back(unsigned(std::stoul(stream.substr(0, 16), nullptr, 2)));
  }
  s.expect_equal(words.drain(), wanted, "words");
}
