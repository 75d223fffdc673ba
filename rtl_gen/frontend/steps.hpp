#pragma once
// Cuts the control flow into steps. A step starts at a cut block, runs through acyclic control flow and ends on an edge
// into a cut block; one step is one iteration of the dataflow graph, one clock. Every loop is cut, so that the code of
// an iteration of a loop nest is one step; a step accesses each port at most once and writes each memory at most once.

#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>

#include <map>
#include <vector>

#include "frontend/lower.hpp"

namespace epiline::frontend {

struct step_structure {
  std::vector<llvm::BasicBlock*> cuts;  // cuts[0] is where the process starts
  std::map<const llvm::BasicBlock*, unsigned> cut_number;
  std::vector<llvm::BasicBlock*> order;  // all blocks; edges into cut blocks aside, predecessors first
  /// The cut block whose step takes the call's scalars: its values may take many clocks (see graph::patient). -1: none.
  int patient_cut = -1;

  [[nodiscard]] bool is_cut(const llvm::BasicBlock* block) const { return cut_number.count(block) != 0; }

  /// Whether a value is chosen by the way that the step before took.
  [[nodiscard]] bool is_cut_phi(const llvm::Value* value) const {
    const auto* phi = llvm::dyn_cast<llvm::PHINode>(value);
    return phi != nullptr && is_cut(phi->getParent());
  }
};

/// Splits blocks of the function where a cut falls inside of one.
[[nodiscard]] step_structure cut_into_steps(lowered_process& process);

}  // namespace epiline::frontend
