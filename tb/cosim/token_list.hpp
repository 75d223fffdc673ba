#pragma once
// Tokens of one port as plain bits.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace epiline::cosim {

/// A sequence of tokens of one width. A token is `words_a_token()` 32-bit words, lowest bits first; the unused high
/// bits of its last word are 0.
class token_list {
 public:
  token_list() = default;
  /// `width` in bits, at least 1.
  explicit token_list(unsigned width) : width_(width), words_a_token_((width + 31) / 32) { assert(width > 0); }

  [[nodiscard]] unsigned width() const { return width_; }
  [[nodiscard]] unsigned words_a_token() const { return words_a_token_; }
  [[nodiscard]] std::size_t size() const { return words_a_token_ == 0 ? 0 : words_.size() / words_a_token_; }
  [[nodiscard]] bool empty() const { return words_.empty(); }

  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t index) const {
    return {words_.data() + index * words_a_token_, words_a_token_};
  }

  void push_back(std::span<const std::uint32_t> token) {
    assert(token.size() == words_a_token_);
    words_.insert(words_.end(), token.begin(), token.end());
  }

  /// A new last token, all 0, to be filled by the caller (valid until the next change of the list).
  std::span<std::uint32_t> append() {
    words_.resize(words_.size() + words_a_token_);
    return {words_.data() + words_.size() - words_a_token_, words_a_token_};
  }

  /// A token of at most 64 bits from an integer.
  void push_integer(std::uint64_t value) {
    const std::span<std::uint32_t> token = append();
    token[0] = static_cast<std::uint32_t>(value);
    if (token.size() > 1) token[1] = static_cast<std::uint32_t>(value >> 32);
  }

  /// The low 64 bits of a token.
  [[nodiscard]] std::uint64_t integer(std::size_t index) const {
    const std::span<const std::uint32_t> token = (*this)[index];
    return token[0] | (token.size() > 1 ? std::uint64_t{token[1]} << 32 : 0);
  }

  void append_all(const token_list& more) {
    assert(more.width_ == width_);
    words_.insert(words_.end(), more.words_.begin(), more.words_.end());
  }

  [[nodiscard]] bool operator==(const token_list&) const = default;

 private:
  unsigned width_ = 0;
  unsigned words_a_token_ = 0;
  std::vector<std::uint32_t> words_;
};

/// Bits [offset, offset + width) of a token, width at most 64. Bits past the last word read as 0.
[[nodiscard]] constexpr std::uint64_t bits_at(std::span<const std::uint32_t> token, unsigned offset, unsigned width) {
  std::uint64_t value = 0;
  for (unsigned done = 0; done < width;) {
    const unsigned word = (offset + done) / 32;
    const unsigned shift = (offset + done) % 32;
    if (word >= token.size()) break;
    value |= (std::uint64_t{token[word]} >> shift) << done;
    done += 32 - shift;
  }
  return width >= 64 ? value : value & ((std::uint64_t{1} << width) - 1);
}

/// Sets bits [offset, offset + width) of a token to the low bits of `value`; width at most 64.
constexpr void set_bits_at(std::span<std::uint32_t> token, unsigned offset, unsigned width, std::uint64_t value) {
  for (unsigned done = 0; done < width;) {
    const unsigned word = (offset + done) / 32;
    const unsigned shift = (offset + done) % 32;
    const unsigned count = width - done < 32 - shift ? width - done : 32 - shift;
    const std::uint32_t ones = count == 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << count) - 1;
    const std::uint32_t part = static_cast<std::uint32_t>(value >> done) & ones;
    token[word] = (token[word] & ~(ones << shift)) | (part << shift);
    done += count;
  }
}

}  // namespace epiline::cosim
