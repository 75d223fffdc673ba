#include "frontend/live_values.hpp"

#include <llvm/IR/CFG.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <set>

namespace epiline::frontend {

using llvm::BasicBlock;
using llvm::Instruction;

live_values find_live_values(const step_structure& steps, const step_flow& flow) {
  std::vector<std::set<const Instruction*>> live(steps.cuts.size());
  for (const BasicBlock* block : steps.order)
    for (const Instruction& instruction : *block) {
      if (instruction.getType()->isVoidTy()) continue;
      std::set<const BasicBlock*> seen;
      std::vector<const BasicBlock*> pending;
      const auto live_into = [&](const BasicBlock* at) {
        if (at == block && !llvm::isa<llvm::PHINode>(instruction)) return;
        if (at == block && llvm::isa<llvm::PHINode>(instruction) && !steps.is_cut(block)) return;
        if (!seen.insert(at).second) return;
        if (steps.is_cut(at)) live[steps.cut_number.at(at)].insert(&instruction);
        if (at == block) return;
        for (const BasicBlock* before : llvm::predecessors(at)) pending.push_back(before);
      };
      for (const llvm::Use& one : instruction.uses()) {
        const auto* user = llvm::cast<Instruction>(one.getUser());
        const BasicBlock* at = user->getParent();
        if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(user)) at = phi->getIncomingBlock(one);
        if (at == block && !steps.is_cut_phi(&instruction)) continue;
        live_into(at);
        while (!pending.empty()) {
          const BasicBlock* next = pending.back();
          pending.pop_back();
          live_into(next);
        }
      }
    }
  live_values ordered;
  for (const auto& values : live) {
    ordered.emplace_back(values.begin(), values.end());
    std::sort(ordered.back().begin(), ordered.back().end(),
              [&](const Instruction* a, const Instruction* b) { return flow.comes_before(a, b); });
  }
  return ordered;
}

}  // namespace epiline::frontend
