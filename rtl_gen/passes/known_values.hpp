#pragma once
// What is known about every value before the machine runs: bits that never change and the interval a value stays in,
// also through registers and memories.

#include <vector>

#include "dataflow/graph.hpp"
#include "passes/value_set.hpp"

namespace epiline::passes {

class known_values {
 public:
  /// Unspecified values count as 0, as in the interpreter.
  explicit known_values(const dataflow::graph& g);

  [[nodiscard]] const value_set& of_node(dataflow::node_id id) const { return nodes_[id]; }
  [[nodiscard]] const value_set& of_register(dataflow::register_id id) const { return registers_[id]; }
  [[nodiscard]] const value_set& of_memory(dataflow::memory_id id) const { return memories_[id]; }
  [[nodiscard]] const value_set& of_table(std::uint32_t id) const { return tables_[id]; }

 private:
  struct fact {  // "in this arm, that node lies in this range"
    dataflow::node_id subject;
    llvm::ConstantRange range;
  };

  void iterate();
  void tighten();
  void evaluate_touched();
  value_set evaluate(dataflow::node_id id) const;
  value_set evaluate_select(const dataflow::node& n) const;
  void add_facts(dataflow::node_id condition, bool holds, unsigned depth, std::vector<fact>& facts) const;
  void add_fact(dataflow::node_id subject, llvm::ConstantRange range, unsigned depth, std::vector<fact>& facts) const;
  value_set refined(dataflow::node_id id, const std::vector<fact>& facts, unsigned depth) const;
  value_set next_of(dataflow::register_id id) const;
  bool is_never(dataflow::node_id bit) const;

  const dataflow::graph& g_;
  std::vector<value_set> nodes_, registers_, memories_, tables_;
  std::vector<char> touched_;  // nodes to evaluate in this round
  std::vector<char> register_changed_, memory_changed_;
};

}  // namespace epiline::passes
