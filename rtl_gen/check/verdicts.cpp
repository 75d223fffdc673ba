#include "check/verdicts.hpp"

#include <fmt/format.h>

#include <ostream>

namespace epiline::check {

void verdicts::row(std::string_view level, std::string_view verdict, const std::string& text) {
  out_ << fmt::format("{:<16} {:<8} {}\n", level, verdict, text) << std::flush;
}

void verdicts::ran(std::string_view level, const std::string& text) {
  ++run_;
  row(level, "run", text);
}

void verdicts::equal(std::string_view level, const std::string& text) {
  ++run_;
  row(level, "equal", text);
}

void verdicts::skip(std::string_view level, const std::string& why) {
  ++skipped_;
  row(level, "skipped", why);
}

void verdicts::differ(std::string_view level, const std::string& text, const difference& where) {
  ++run_;
  row(level, "DIFFERS", text);
  if (!first_level_.empty()) return;
  first_level_ = level;
  first_text_ = text;
  first_where_ = where;
}

void verdicts::print_end() {
  out_ << fmt::format("{} levels are equal{}\n", run_, skipped_ == 0 ? "" : fmt::format(", {} skipped", skipped_));
}

}  // namespace epiline::check
