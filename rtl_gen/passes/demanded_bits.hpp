#pragma once
// Which bits of every value anything depends on, also through registers and memories.

#include <llvm/ADT/APInt.h>

#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::passes {

class demanded_bits {
 public:
  explicit demanded_bits(const dataflow::graph& g);

  /// A bit that is 0 here may take any value without changing what the graph outputs.
  [[nodiscard]] const llvm::APInt& of_node(dataflow::node_id id) const { return nodes_[id]; }
  [[nodiscard]] const llvm::APInt& of_register(dataflow::register_id id) const { return registers_[id]; }
  [[nodiscard]] const llvm::APInt& of_memory(dataflow::memory_id id) const { return memories_[id]; }
  [[nodiscard]] const llvm::APInt& of_table(std::uint32_t id) const { return tables_[id]; }

 private:
  void demand(dataflow::node_id id, const llvm::APInt& bits);
  void demand_all(dataflow::node_id id);
  void pass_on(dataflow::node_id id);
  void pass_on_shift(const dataflow::node& n, const llvm::APInt& bits);
  void pass_on_state(const dataflow::node& n, const llvm::APInt& bits);

  const dataflow::graph& g_;
  std::vector<llvm::APInt> nodes_, registers_, memories_, tables_;
  std::vector<std::vector<dataflow::node_id>> writes_;  // of each memory
  std::vector<dataflow::node_id> pending_;              // a heap, latest node first: users before their operands
  std::vector<char> is_pending_;
};

}  // namespace epiline::passes
