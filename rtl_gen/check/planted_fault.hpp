#pragma once
// Faults that a test of --check plants in the text of a level, to see that it is found there.

#include <optional>
#include <string>

namespace epiline::check {

class planted_fault {
 public:
  /// `text` is "LEVEL:FROM:TO", or empty: no fault. Throws std::invalid_argument for anything else.
  explicit planted_fault(const std::string& text);

  /// The text of a level, with the fault that is planted in it.
  [[nodiscard]] std::string text_of(const std::string& level, std::string text);
  /// Whether the fault is one of `level`.
  [[nodiscard]] bool is_for(const std::string& level) const { return fault_ && fault_->level == level; }
  /// A sentence, if there is a fault whose text was nowhere in its level; otherwise empty.
  [[nodiscard]] std::string missing() const;

 private:
  struct fault {
    std::string level, from, to;
  };
  std::optional<fault> fault_;
  bool is_in_ = false;
};

}  // namespace epiline::check
