#pragma once
// How a value is written in Verilog where it is used: by its name, by that of a flip-flop it waits in, or, while it is
// short and used once, as the expression itself.

#include <cstdint>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/module_design.hpp"
#include "emit/module_names.hpp"
#include "schedule/fan_out.hpp"

namespace epiline::emit {

struct value_text {
  std::string text;
  bool primary = true;     // may stand beside any operator without parentheses
  bool identifier = true;  // a bit select may follow
};

class expressions {
 public:
  expressions(const module_design& design, const module_names& names);

  /// Whose text is being written from now on: decides which copy of a flip-flop it names.
  void read_by(schedule::reader reader) { reader_ = reader; }

  /// Whether a value's text is part of its users' text.
  [[nodiscard]] bool is_inlined(dataflow::node_id id) const { return inlined_[id] != 0; }

  /// The value of a node in a stage.
  [[nodiscard]] value_text at(dataflow::node_id id, int stage) const;
  [[nodiscard]] std::string operand(dataflow::node_id id, int stage) const;  // parenthesised unless primary
  [[nodiscard]] std::string whole(dataflow::node_id id, int stage) const;    // as a complete expression
  /// What a node computes, in its own stage.
  [[nodiscard]] value_text expression(dataflow::node_id id) const;
  /// `width` bits from bit `low` on of `v`, the text of `source`.
  [[nodiscard]] std::string part(const value_text& v, dataflow::node_id source, unsigned low, unsigned width) const;
  /// An address, as wide as `words` words need.
  [[nodiscard]] std::string index(dataflow::node_id address, int stage, std::uint64_t words) const;

  /// The bit that says whether `stage` holds an iteration.
  [[nodiscard]] std::string valid(int stage) const;
  /// The flip-flop that is 1 where `stage` holds an iteration and `condition` is true in it; empty if there is none.
  [[nodiscard]] std::string update_bit(dataflow::node_id condition, int stage) const;
  /// The reset of state: some clocks later than that of handshakes, and as long as iterations may be in flight.
  [[nodiscard]] std::string state_reset() const;
  /// The name of the flip-flops `name`, of which there are `all`, that the present reader looks at.
  [[nodiscard]] std::string copy_of(const std::string& name, const copies& all) const;

 private:
  void choose_inlined();
  [[nodiscard]] value_text shift(dataflow::node_id id) const;
  [[nodiscard]] std::string joined(dataflow::node_id id) const;

  const dataflow::graph& g_;
  const schedule::result& s_;
  const plan& plan_;
  const module_names& names_;
  std::vector<char> inlined_;
  schedule::reader reader_ = 0;
};

}  // namespace epiline::emit
