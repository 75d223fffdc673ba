#pragma once
// What the text forms of graphs and of networks have in common.

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/ADT/StringRef.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "dataflow/text.hpp"

namespace epiline::dataflow {

/// "text" with the escapes of text.hpp.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// " @file:line" if it is known, and the line's end.
[[nodiscard]] std::string place_and_end(const source_location& where);

/// The lines of a port and its fields.
[[nodiscard]] std::string print_port(const port& p);

/// Reads the pieces of one line. Every `need_` function throws when something else stands there.
class line_reader {
 public:
  line_reader(std::string_view line, unsigned number) : rest_(line), number_(number) { skip_blanks(); }

  [[noreturn]] void fail(const std::string& what) const { throw text_error(fmt::format("line {}: {}", number_, what)); }

  bool at_end() const { return rest_.empty() || rest_.front() == ';'; }

  /// Takes `piece` if it stands here. A word is taken only whole.
  bool take(std::string_view piece) {
    if (rest_.substr(0, piece.size()) != piece) return false;
    const bool is_word = is_word_character(piece.back());
    if (is_word && rest_.size() > piece.size() && is_word_character(rest_[piece.size()])) return false;
    rest_.remove_prefix(piece.size());
    skip_blanks();
    return true;
  }

  void need(std::string_view piece) {
    if (!take(piece)) unexpected(fmt::format("'{}'", piece));
  }

  std::string_view need_word(const char* expected) {
    std::size_t length = 0;
    while (length < rest_.size() && is_word_character(rest_[length])) ++length;
    if (length == 0) unexpected(expected);
    return advance(length);
  }

  std::uint32_t need_number(const char* expected, std::uint32_t least, std::uint32_t most) {
    std::uint64_t value = 0;
    const char* const first = rest_.data();
    const auto [end, error] = std::from_chars(first, first + rest_.size(), value);
    const auto length = static_cast<std::size_t>(end - first);
    if (error == std::errc::invalid_argument || (length < rest_.size() && is_word_character(rest_[length])))
      unexpected(expected);
    if (error != std::errc() || value < least || value > most)
      fail(fmt::format("found {}, expected {} from {} to {}", rest_.substr(0, std::min<std::size_t>(length, 20)),
                       expected, least, most));
    advance(length);
    return static_cast<std::uint32_t>(value);
  }

  unsigned need_width() { return need_number("a width", 1, max_width); }

  llvm::APInt need_value(unsigned width) {
    if (!rest_.starts_with("0x")) unexpected("a value 0x...");
    std::size_t length = 2;
    while (length < rest_.size() && llvm::isHexDigit(rest_[length])) ++length;
    if (length == 2 || (length < rest_.size() && is_word_character(rest_[length]))) unexpected("a value 0x...");
    std::string_view digits = rest_.substr(2, length - 2);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (digits.size() > (width + 3) / 4) fail(fmt::format("the value does not fit, expected at most {} bits", width));
    // A little room, so that a first digit of more bits than the width can be seen.
    const llvm::APInt value(width + 4, llvm::StringRef(digits.data(), digits.size()), 16);
    if (value.getActiveBits() > width) fail(fmt::format("the value does not fit, expected at most {} bits", width));
    advance(length);
    return value.trunc(width);
  }

  node_id need_node() {
    if (rest_.empty() || rest_.front() != '%') unexpected("a node %N");
    rest_.remove_prefix(1);
    return need_number("a node number", 0, none - 1);
  }

  std::string need_string(const char* expected) {
    if (rest_.empty() || rest_.front() != '"') unexpected(expected);
    std::string result;
    std::size_t i = 1;
    for (;; ++i) {
      if (i >= rest_.size()) fail("the string has no end, expected '\"'");
      if (rest_[i] == '"') break;
      if (rest_[i] != '\\') {
        result += rest_[i];
        continue;
      }
      ++i;
      const char escape = i < rest_.size() ? rest_[i] : '\0';
      if (escape == '"' || escape == '\\') {
        result += escape;
      } else if (escape == 'n' || escape == 't') {
        result += escape == 'n' ? '\n' : '\t';
      } else if (escape == 'x' && i + 2 < rest_.size() && llvm::isHexDigit(rest_[i + 1]) &&
                 llvm::isHexDigit(rest_[i + 2])) {
        result += static_cast<char>(llvm::hexFromNibbles(rest_[i + 1], rest_[i + 2]));
        i += 2;
      } else {
        fail("unknown escape in a string, expected \\\" \\\\ \\n \\t or \\xNN");
      }
    }
    advance(i + 1);
    return result;
  }

  bool at_string() const { return !rest_.empty() && rest_.front() == '"'; }

  /// `@file:line`, if it stands here, and then the line's end.
  source_location need_place_and_end() {
    source_location where;
    if (take("@")) {
      where.file = need_number("a file number", 0, none);
      need(":");
      where.line = need_number("a line number", 0, none);
    }
    need_end();
    return where;
  }

  void need_end() {
    if (!at_end()) unexpected("the end of the line");
  }

  [[noreturn]] void unexpected(std::string_view expected) const {
    std::size_t length = 0;
    while (length < rest_.size() && length < 20 && is_word_character(rest_[length])) ++length;
    std::string found =
        at_end() ? "the end of the line" : fmt::format("'{}'", rest_.substr(0, std::max<std::size_t>(length, 1)));
    if (!at_end() && length == 0 && !llvm::isPrint(rest_.front()))
      found = fmt::format("byte 0x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(rest_.front())));
    fail(fmt::format("found {}, expected {}", found, expected));
  }

 private:
  static bool is_word_character(char c) { return llvm::isAlnum(c) || c == '_'; }

  std::string_view advance(std::size_t length) {
    const std::string_view piece = rest_.substr(0, length);
    rest_.remove_prefix(length);
    skip_blanks();
    return piece;
  }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }

  std::string_view rest_;
  unsigned number_;
};

/// The rest of a line that began with `input` or `output`; the port has no fields yet.
[[nodiscard]] port parse_port(line_reader& line, bool input);

/// The rest of a line that began with `field`: one more of the port.
void append_field(line_reader& line, port& to);

/// The graph of a text that is a part of another: errors count `lines_before` lines more.
[[nodiscard]] graph parse_part(std::string_view text, unsigned lines_before);

}  // namespace epiline::dataflow
