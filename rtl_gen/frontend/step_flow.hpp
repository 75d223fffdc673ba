#pragma once
// Which blocks a step runs through, and in what order: reachability and dominators in the control flow between cuts.

#include <llvm/IR/BasicBlock.h>
#include <llvm/IR/Instruction.h>

#include <unordered_map>
#include <vector>

#include "frontend/steps.hpp"

namespace epiline::frontend {

/// An edge of the control flow.
struct control_edge {
  const llvm::BasicBlock* from;
  const llvm::BasicBlock* to;
  auto operator<=>(const control_edge&) const = default;
};

/// Whether no step comes here: the source promises it, or the behaviour would be undefined.
[[nodiscard]] bool is_impossible(const llvm::BasicBlock* block);

class step_flow {
 public:
  explicit step_flow(const step_structure& steps);

  [[nodiscard]] bool contains(const llvm::BasicBlock* block) const { return position_.count(block) != 0; }

  /// Whether a step can run through `from` and then `to`.
  [[nodiscard]] bool reaches(const llvm::BasicBlock* from, const llvm::BasicBlock* to) const;

  /// Those in the same step, each once.
  [[nodiscard]] std::vector<const llvm::BasicBlock*> predecessors(const llvm::BasicBlock* block) const;

  /// The nearest block that every step runs through before this one; null: there is none.
  [[nodiscard]] const llvm::BasicBlock* dominator(const llvm::BasicBlock* block) const;
  [[nodiscard]] bool dominates(const llvm::BasicBlock* above, const llvm::BasicBlock* below) const;

  /// The dominator, if it is always followed by this block: the two run together. Otherwise null.
  [[nodiscard]] const llvm::BasicBlock* always_with(const llvm::BasicBlock* block) const;

  [[nodiscard]] bool comes_before(const llvm::Instruction* a, const llvm::Instruction* b) const;

 private:
  [[nodiscard]] int position(const llvm::BasicBlock* block) const { return position_.at(block); }
  void find_reachable();
  void find_dominators();
  void find_postdominators();

  const step_structure& steps_;
  std::unordered_map<const llvm::BasicBlock*, int> position_;
  std::vector<std::vector<bool>> reaches_;
  // As positions. -1 is the start of the step, the number of blocks its end.
  std::vector<int> dominator_;
  std::vector<int> postdominator_;
};

}  // namespace epiline::frontend
