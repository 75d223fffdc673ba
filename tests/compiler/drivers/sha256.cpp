#include <cmath>

#include "../drive.hpp"
namespace kernel_sha256 {
#include "../kernels/sha256.cpp"
}
using namespace kernel_sha256;

namespace {

// FIPS 180-4 over a whole message; the constants from the roots of primes.
std::vector<std::uint32_t> reference_digest(std::string text) {
  std::vector<std::uint32_t> k, h;
  for (int n = 2; k.size() < 64; ++n) {
    bool prime = true;
    for (int d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
    if (!prime) continue;
    const long double cube = std::cbrt((long double)n), square = std::sqrt((long double)n);
    k.push_back(std::uint32_t(std::floor((cube - std::floor(cube)) * 4294967296.0L)));
    if (h.size() < 8) h.push_back(std::uint32_t(std::floor((square - std::floor(square)) * 4294967296.0L)));
  }
  const std::uint64_t length = 8 * text.size();
  text += '\x80';
  while (text.size() % 64 != 56) text += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) text += char(length >> shift);
  const auto turn = [](std::uint32_t x, int n) { return x >> n | x << (32 - n); };
  for (std::size_t at = 0; at < text.size(); at += 64) {
    std::vector<std::uint32_t> w;
    for (std::size_t t = 0; t < 64; ++t) {
      std::uint32_t v = 0;
      if (t < 16) {
        for (std::size_t b = 0; b < 4; ++b) v = v << 8 | static_cast<unsigned char>(text[at + 4 * t + b]);
      } else {
        const std::uint32_t x = w[t - 15], y = w[t - 2];
        v = w[t - 16] + w[t - 7] + (turn(x, 7) ^ turn(x, 18) ^ x >> 3) + (turn(y, 17) ^ turn(y, 19) ^ y >> 10);
      }
      w.push_back(v);
    }
    std::vector<std::uint32_t> v = h;
    for (std::size_t t = 0; t < 64; ++t) {
      const std::uint32_t first =
          v[7] + (turn(v[4], 6) ^ turn(v[4], 11) ^ turn(v[4], 25)) + ((v[4] & v[5]) ^ (~v[4] & v[6])) + k[t] + w[t];
      const std::uint32_t second =
          (turn(v[0], 2) ^ turn(v[0], 13) ^ turn(v[0], 22)) + ((v[0] & v[1]) ^ (v[0] & v[2]) ^ (v[1] & v[2]));
      v.insert(v.begin(), first + second);
      v[4] += first;
      v.pop_back();
    }
    for (std::size_t i = 0; i < 8; ++i) h[i] += v[i];
  }
  return h;
}

}  // namespace

EPILINE_DRIVER(sha256) {
  auto& message = s.input<beat_t>("message");
  auto& digest = s.output<word_t>("digest");
  std::vector<std::uint32_t> wanted;
  std::vector<std::string> texts = {"abc", ""};
  for (const int size : {55, 56, 130}) {
    texts.emplace_back();
    for (int i = 0; i < size; ++i) texts.back() += char(s.number(0, 255));
  }
  for (std::string text : texts) {
    const auto h = reference_digest(text);
    wanted.insert(wanted.end(), h.begin(), h.end());
    const std::uint64_t length = 8 * text.size();
    text += '\x80';
    while (text.size() % 64 != 56) text += '\0';
    for (int shift = 56; shift >= 0; shift -= 8) text += char(length >> shift);
    for (std::size_t i = 0; i < text.size(); i += 4) {
      beat_t beat = s.any<beat_t>();
      beat.data = 0;
      for (std::size_t b = 0; b < 4; ++b) beat.data = (beat.data << 8) | static_cast<unsigned char>(text[i + b]);
      if (i % 64 == 60) beat.last = i + 4 == text.size();  // on other words it means nothing
      message.push(beat);
    }
    sha256(message.stream, digest.stream);
  }
  s.expect(wanted[0] == 0xba7816bf && wanted[8] == 0xe3b0c442, "the reference itself");
  s.expect_equal(digest.drain(), wanted, "digest");
}
