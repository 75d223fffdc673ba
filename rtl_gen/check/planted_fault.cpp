#include "check/planted_fault.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace epiline::check {

planted_fault::planted_fault(const std::string& text) {
  if (text.empty()) return;
  const std::size_t first = text.find(':');
  const std::size_t second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second == std::string::npos) throw std::invalid_argument("--fault: write LEVEL:FROM:TO");
  fault_ = fault{text.substr(0, first), text.substr(first + 1, second - first - 1), text.substr(second + 1)};
}

std::string planted_fault::text_of(const std::string& level, std::string text) {
  if (!is_for(level)) return text;
  const std::size_t at = text.find(fault_->from);
  if (at == std::string::npos) return text;
  is_in_ = true;
  return text.replace(at, fault_->from.size(), fault_->to);
}

std::string planted_fault::missing() const {
  if (!fault_ || is_in_) return {};
  return fmt::format("error: --fault: '{}' is not in level {}", fault_->from, fault_->level);
}

}  // namespace epiline::check
