#include <array>

#include "../drive.hpp"
namespace kernel_aes128 {
#include "../kernels/aes128.cpp"
}
using namespace kernel_aes128;

namespace {

// FIPS 197 by its definitions: the S-box from inverses in GF(2^8), the key schedule over all words first.
int multiply(int a, int b) {
  int product = 0;
  for (; b != 0; b >>= 1) {
    if (b & 1) product ^= a;
    a = a << 1 ^ (a & 128 ? 0x11b : 0);
  }
  return product;
}
int substitute(int x) {
  int inverse = 0;
  while (x != 0 && multiply(x, inverse) != 1) ++inverse;
  int result = 0x63;
  for (int turn = 0; turn < 5; ++turn) result ^= (inverse << turn | inverse >> (8 - turn)) & 255;
  return result;
}
using bytes16 = std::array<int, 16>;
bytes16 encrypt(const bytes16& plain, const bytes16& key, const std::vector<int>& box) {
  std::vector<std::array<int, 4>> words;
  for (std::size_t i = 0; i < 4; ++i) words.push_back({key[4 * i], key[4 * i + 1], key[4 * i + 2], key[4 * i + 3]});
  int constant = 1;
  for (std::size_t i = 4; i < 44; ++i) {
    std::array<int, 4> w = words[i - 1];
    if (i % 4 == 0) {
      w = {box[std::size_t(w[1])] ^ constant, box[std::size_t(w[2])], box[std::size_t(w[3])], box[std::size_t(w[0])]};
      constant = multiply(constant, 2);
    }
    for (std::size_t k = 0; k < 4; ++k) w[k] ^= words[i - 4][k];
    words.push_back(w);
  }
  bytes16 state = plain;
  for (std::size_t i = 0; i < 16; ++i) state[i] ^= words[i / 4][i % 4];
  for (std::size_t round = 1; round <= 10; ++round) {
    bytes16 shifted;
    for (std::size_t i = 0; i < 16; ++i) shifted[i] = box[std::size_t(state[(i + 4 * (i % 4)) % 16])];
    for (std::size_t i = 0; i < 16; ++i) {
      const auto at = [&](std::size_t k) { return shifted[i / 4 * 4 + (i + k) % 4]; };
      state[i] = round == 10 ? shifted[i] : multiply(at(0), 2) ^ multiply(at(1), 3) ^ at(2) ^ at(3);
      state[i] ^= words[4 * round + i / 4][i % 4];
    }
  }
  return state;
}
ap_uint<128> beat_of(const bytes16& bytes) {
  ap_uint<128> value = 0;
  for (const int byte : bytes) value = (value << 8) | byte;
  return value;
}

}  // namespace

EPILINE_DRIVER(aes128) {
  auto& plain = s.input<block_t>("plain");
  auto& cipher = s.output<block_t>("cipher");
  std::vector<int> box;
  for (int i = 0; i < 256; ++i) box.push_back(substitute(i));
  std::vector<ap_uint<128>> wanted;
  for (int call = 0; call < 4; ++call) {
    bytes16 key;
    for (int i = 0; i < 16; ++i) key[std::size_t(i)] = call == 0 ? i : int(s.number(0, 255));
    for (int n = 0; n < 12; ++n) {
      bytes16 text;
      for (int i = 0; i < 16; ++i) text[std::size_t(i)] = call == 0 && n == 0 ? 0x11 * i : int(s.number(0, 255));
      block_t beat = s.any<block_t>();
      beat.data = beat_of(text);
      beat.last = n == 11;
      plain.push(beat);
      wanted.push_back(beat_of(encrypt(text, key, box)));
    }
    s.call({{"key", beat_of(key)}});
    aes128(plain.stream, cipher.stream, beat_of(key));
  }
  std::vector<ap_uint<128>> found;
  for (const block_t& beat : cipher.drain()) found.push_back(beat.data);
  s.expect_equal(found, wanted, "cipher");
  // Appendix C.1 of the standard.
  s.expect(!found.empty() && found[0] == ap_uint<128>("69c4e0d86a7b0430d8cdb78070b4c55a", 16),
           "the standard's example");
}
