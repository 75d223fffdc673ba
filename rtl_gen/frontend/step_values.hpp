#pragma once
// The values of a step as nodes: what an instruction computes, whether a step runs through a block or along an edge,
// and what it takes from and gives to ports and memories. Each needs the others: a predicate is made of conditions,
// which are values; a value may be chosen by predicates, or read from a memory.

#include <llvm/IR/Instructions.h>

#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/graph_nodes.hpp"
#include "frontend/machine_start.hpp"
#include "frontend/step_flow.hpp"
#include "frontend/step_registers.hpp"

namespace epiline::frontend {

class step_values {
 public:
  using node_id = dataflow::node_id;

  step_values(const step_structure& steps, const step_flow& flow, const machine_start& start,
              const step_registers& registers, graph_nodes& nodes, dataflow::graph& graph);

  /// The value as the end of block `at` (or an instruction in it) sees it.
  node_id use(const llvm::Value* value, const llvm::BasicBlock* at);

  /// Whether a step runs along the edge, given that it runs through `root` (null: given nothing).
  node_id edge_predicate(const control_edge& along, const llvm::BasicBlock* root = nullptr);

  /// Makes the nodes of all accesses to ports and memories.
  void build_effects();

 private:
  struct access_list {
    std::vector<const llvm::CallInst*> reads;
    std::vector<const llvm::CallInst*> writes;
  };

  // step_values.cpp
  node_id node_of(const llvm::Instruction& instruction);
  node_id register_value(const llvm::Instruction* value);
  node_id predicate(const llvm::BasicBlock* block, const llvm::BasicBlock* root = nullptr);
  node_id switch_edge(const llvm::SwitchInst& choice, const control_edge& along);
  /// A phi inside a step: selects by the edge taken, relative to the nearest block all edges come through.
  node_id join(const llvm::PHINode& phi);

  // step_instructions.cpp
  node_id translate(const llvm::Instruction& at);
  node_id compare(const llvm::ICmpInst& at);
  node_id call(const llvm::CallInst& at);
  node_id funnel_shift(const llvm::CallInst& at, bool left);

  // step_accesses.cpp
  void collect_accesses(const llvm::BasicBlock& block);
  /// All reads of a port are one node: a step takes at most one of its tokens.
  void read_tokens(unsigned port);
  /// What a write of a step earlier in program order leaves for a read of the same step is forwarded here, so that in
  /// the graph all reads of a memory stand before its write.
  node_id memory_read(const llvm::CallInst& at);
  node_id write_enable(const llvm::CallInst& write);
  node_id memory_address(const llvm::CallInst& at);
  void build_write(unsigned port, const std::vector<const llvm::CallInst*>& writes);
  void build_memory_write(unsigned object, const std::vector<const llvm::CallInst*>& writes);

  const step_structure& steps_;
  const step_flow& flow_;
  const machine_start& start_;
  const step_registers& registers_;
  graph_nodes& nodes_;
  dataflow::graph& graph_;
  std::unordered_map<const llvm::Instruction*, node_id> translated_;
  std::map<std::pair<const llvm::Instruction*, const llvm::BasicBlock*>, node_id> mixed_;
  std::map<std::pair<const llvm::BasicBlock*, const llvm::BasicBlock*>, node_id> block_predicates_;
  std::map<std::pair<control_edge, const llvm::BasicBlock*>, node_id> edge_predicates_;
  std::map<unsigned, access_list> port_accesses_;
  std::map<unsigned, access_list> memory_accesses_;
  std::map<std::tuple<unsigned, node_id, node_id>, node_id> memory_reads_;
};

}  // namespace epiline::frontend
