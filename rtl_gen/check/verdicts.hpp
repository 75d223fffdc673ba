#pragma once
// The table that --check prints, a line a level, and the first level that differs.

#include <iosfwd>
#include <string>
#include <string_view>

#include "check/answer.hpp"

namespace epiline::check {

class verdicts {
 public:
  explicit verdicts(std::ostream& out) : out_(out) {}

  /// The level that the others are compared with.
  void ran(std::string_view level, const std::string& text);
  void equal(std::string_view level, const std::string& text);
  void skip(std::string_view level, const std::string& why);
  /// `where` may be without a token.
  void differ(std::string_view level, const std::string& text, const difference& where = {});
  /// The last line, if nothing differs.
  void print_end();

  /// The first level that differs, what differs, and the token; empty: none does.
  [[nodiscard]] const std::string& first_level() const { return first_level_; }
  [[nodiscard]] const std::string& first_text() const { return first_text_; }
  [[nodiscard]] const difference& first_where() const { return first_where_; }

 private:
  void row(std::string_view level, std::string_view verdict, const std::string& text);

  std::ostream& out_;
  std::size_t run_ = 0, skipped_ = 0;
  std::string first_level_, first_text_;
  difference first_where_;
};

}  // namespace epiline::check
