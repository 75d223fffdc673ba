#pragma once
// Values as 64-bit words, the low word first; bits above a value's width are 0.

#include <algorithm>
#include <cstdint>

namespace epiline::dataflow {

using word = std::uint64_t;
inline constexpr unsigned word_bits = 64;

[[nodiscard]] inline std::uint32_t words_for(unsigned width) { return (width + word_bits - 1) / word_bits; }

/// Bit 63 - shift of `value` is its sign.
[[nodiscard]] inline word sign_extended(word value, unsigned shift) {
  return static_cast<word>(static_cast<std::int64_t>(value << shift) >> shift);
}

[[nodiscard]] inline std::int64_t as_signed(word value) { return static_cast<std::int64_t>(value); }

/// `width` bits of a multi-word value, from bit `low`; width <= 64.
[[nodiscard]] inline word extract(const word* value, unsigned low, unsigned width) {
  const unsigned index = low / word_bits, shift = low % word_bits;
  word result = value[index] >> shift;
  if (shift != 0 && shift + width > word_bits) result |= value[index + 1] << (word_bits - shift);
  return result & (~word{0} >> (word_bits - width));
}

/// Puts `width` bits at bit `low` of a multi-word value that is zero there; `part` has zeros above its width.
inline void deposit(word* value, unsigned low, unsigned width, const word* part) {
  for (unsigned done = 0; done < width; done += word_bits, ++part) {
    const unsigned index = (low + done) / word_bits, shift = (low + done) % word_bits;
    value[index] |= *part << shift;
    if (shift != 0 && shift + std::min(word_bits, width - done) > word_bits)
      value[index + 1] |= *part >> (word_bits - shift);
  }
}

}  // namespace epiline::dataflow
