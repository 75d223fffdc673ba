#pragma once
// What the programs that --check builds have in common: tokens, the file they read and the file they write.
//
// The input has a line `PORT HEXADECIMAL` for every token, by the port's number in the network, oldest first. The
// output has
//   out PORT HEXADECIMAL LINE    a token written; LINE numbers the source line of the write, 0 = not known
//   in PORT HEXADECIMAL          a token made up and read (random stimulus only)
//   read PORT COUNT              tokens that were read of an input
//   done PORT COUNT              tokens written to an output when the last call came to its end
//   calls COUNT                  calls of the top that came to their end
//   end WORD                     why it stopped: see `ending`

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "check_ending.hpp"

namespace epiline::check {

/// A bit pattern, the lowest bit first.
class token {
 public:
  token() = default;
  explicit token(std::vector<std::uint64_t> words) : words_(std::move(words)) {}

  /// Appends the low `width` (1..64) bits of `value`.
  void put(std::uint64_t value, unsigned width) {
    if (width < 64) value &= (std::uint64_t{1} << width) - 1;
    if (width_ % 64 == 0) words_.push_back(0);
    words_.back() |= value << (width_ % 64);
    if (width_ % 64 + width > 64) words_.push_back(value >> (64 - width_ % 64));
    width_ += width;
  }
  /// The next `width` (1..64) bits from `position` on, which moves behind them.
  std::uint64_t take(unsigned& position, unsigned width) const {
    const std::size_t word = position / 64;
    const unsigned low = position % 64;
    position += width;
    std::uint64_t value = word < words_.size() ? words_[word] >> low : 0;
    if (low + width > 64 && word + 1 < words_.size()) value |= words_[word + 1] << (64 - low);
    return width < 64 ? value & ((std::uint64_t{1} << width) - 1) : value;
  }
  const std::vector<std::uint64_t>& words() const { return words_; }

 private:
  std::vector<std::uint64_t> words_;
  unsigned width_ = 0;  // of what was put
};

inline token read_hexadecimal(const char* text) {
  std::size_t digits = 0;
  while (text[digits] != '\0' && text[digits] != '\n') ++digits;
  token result;
  for (std::size_t i = digits; i-- > 0;) {
    const char c = text[i];
    result.put(static_cast<std::uint64_t>(c <= '9' ? c - '0' : c - 'a' + 10), 4);
  }
  return result;
}

inline std::string to_hexadecimal(const token& value) {
  std::string text;
  for (std::size_t word = value.words().size(); word-- > 0;)
    for (int low = 60; low >= 0; low -= 4) {
      const unsigned digit = static_cast<unsigned>(value.words()[word] >> low) & 15;
      if (digit != 0 || !text.empty()) text += "0123456789abcdef"[digit];
    }
  return text.empty() ? "0" : text;
}

/// What goes in and what comes out, by port.
class exchange {
 public:
  void load(const char* file) {
    std::FILE* const in = std::fopen(file, "r");
    if (in == nullptr) stop("cannot read", file);
    std::string line;
    for (int c = std::fgetc(in); c != EOF; c = std::fgetc(in)) {
      if (c != '\n') {
        line += static_cast<char>(c);
        continue;
      }
      char* end = nullptr;
      const long port = std::strtol(line.c_str(), &end, 10);
      inputs[static_cast<unsigned>(port)].push_back(read_hexadecimal(end + 1));
      line.clear();
    }
    std::fclose(in);
  }

  void written(unsigned port, const token& value, unsigned line = 0) {
    lines_ += "out " + std::to_string(port) + ' ' + to_hexadecimal(value) + ' ' + std::to_string(line) + '\n';
    ++outputs[port];
  }
  void made_up(unsigned port, const token& value) {
    lines_ += "in " + std::to_string(port) + ' ' + to_hexadecimal(value) + '\n';
  }

  /// What is written so far belongs to calls that came to their end.
  void call_is_done() { done_ = outputs; }

  /// Writes everything and ends the program, without destructors: streams may hold tokens.
  [[noreturn]] void finish(const char* file, ending why, const std::map<unsigned, std::uint64_t>& reads) {
    for (const auto& [port, count] : reads)
      lines_ += "read " + std::to_string(port) + ' ' + std::to_string(count) + '\n';
    for (const auto& [port, count] : done_)
      lines_ += "done " + std::to_string(port) + ' ' + std::to_string(count) + '\n';
    lines_ += "calls " + std::to_string(calls) + '\n';
    lines_ += std::string("end ") + ending_names[static_cast<int>(why)] + '\n';
    std::FILE* const out = std::fopen(file, "w");
    if (out == nullptr || std::fwrite(lines_.data(), 1, lines_.size(), out) != lines_.size() || std::fclose(out) != 0)
      stop("cannot write", file);
    std::fflush(nullptr);
    std::_Exit(0);
  }

  [[noreturn]] static void stop(const char* what, const char* object) {
    std::fprintf(stderr, "error: %s %s\n", what, object);
    std::_Exit(3);
  }

  std::map<unsigned, std::deque<token>> inputs;
  std::map<unsigned, std::uint64_t> outputs;  // tokens written
  std::uint64_t calls = 0;

 private:
  std::string lines_;
  std::map<unsigned, std::uint64_t> done_;
};

}  // namespace epiline::check
