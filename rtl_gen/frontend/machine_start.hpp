#pragma once
// Where the machine starts. The function's entry only sets initial values: when it goes straight to another cut with
// constants, the machine starts there and the constants become reset values.

#include <llvm/IR/BasicBlock.h>
#include <llvm/IR/Constant.h>
#include <llvm/IR/Instruction.h>

#include <vector>

#include "frontend/live_values.hpp"

namespace epiline::frontend {

struct start_value {
  llvm::Constant* number = nullptr;  // null: not a constant
  bool is_kept_at_reset = false;
};

class machine_start {
 public:
  machine_start(const step_structure& steps, const step_flow& flow, const live_values& live);

  /// The cut block of the first step.
  [[nodiscard]] const llvm::BasicBlock* first() const { return first_; }

  /// Whether the entry is no step: what it computes are initial values.
  [[nodiscard]] bool is_folded() const { return first_ != path_.front(); }

  /// What a value is on the way from the function's entry to the first cut.
  [[nodiscard]] start_value value_of(const llvm::Value* value) const;

  /// Whether steps start at a cut, run through a block.
  [[nodiscard]] bool runs(unsigned cut) const { return cut != 0 || !is_folded(); }
  [[nodiscard]] bool runs(const llvm::BasicBlock* block) const;

  [[nodiscard]] bool only_in_patient_steps(const llvm::BasicBlock* block) const;

 private:
  [[nodiscard]] bool can_start_at(const llvm::BasicBlock& cut, const live_values& live) const;

  const step_structure& steps_;
  const step_flow& flow_;
  std::vector<const llvm::BasicBlock*> path_;  // from the function's entry to the first cut behind it
  const llvm::BasicBlock* first_;
};

}  // namespace epiline::frontend
