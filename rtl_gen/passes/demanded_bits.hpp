#pragma once
// Which bits of every value anything depends on, also through registers and memories.

#include <llvm/ADT/APInt.h>

#include <vector>

#include "dataflow/graph.hpp"
#include "passes/known_values.hpp"

namespace epiline::passes {

class demanded_bits {
 public:
  /// With `known`, which must outlive the call only, bits that are known to be zero are not demanded, and of bits that
  /// are known to repeat the sign only the lowest is: from it the others follow.
  explicit demanded_bits(const dataflow::graph& g, const known_values* known = nullptr);

  /// A bit that is 0 here may take any value without changing what the graph outputs (with `known`: if the bits that
  /// follow from others are taken from them).
  [[nodiscard]] const llvm::APInt& of_node(dataflow::node_id id) const { return nodes_[id]; }
  [[nodiscard]] const llvm::APInt& of_register(dataflow::register_id id) const { return registers_[id]; }
  [[nodiscard]] const llvm::APInt& of_memory(dataflow::memory_id id) const { return memories_[id]; }
  [[nodiscard]] const llvm::APInt& of_table(std::uint32_t id) const { return tables_[id]; }

 private:
  void demand(dataflow::node_id id, llvm::APInt bits);
  void demand_all(dataflow::node_id id);
  void pass_on(dataflow::node_id id);
  void pass_on_shift(const dataflow::node& n, const llvm::APInt& bits);
  void pass_on_state(const dataflow::node& n, const llvm::APInt& bits);

  const dataflow::graph& g_;
  const known_values* known_;
  std::vector<llvm::APInt> nodes_, registers_, memories_, tables_;
  std::vector<std::vector<dataflow::node_id>> writes_;  // of each memory
  std::vector<dataflow::node_id> pending_;              // a heap, latest node first: users before their operands
  std::vector<char> is_pending_;
};

}  // namespace epiline::passes
