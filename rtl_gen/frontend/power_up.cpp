#include "frontend/power_up.hpp"

#include <llvm/Analysis/ConstantFolding.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include <vector>

#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

/// The operands of `at` with their values at power-up; empty if another one is among them, or none.
llvm::SmallVector<llvm::Constant*> operands_at_power_up(llvm::Instruction& at) {
  llvm::SmallVector<llvm::Constant*> operands;
  bool is_hidden = false;
  for (llvm::Value* operand : at.operands()) {
    const llvm::Constant* hidden = power_up_value(operand);
    is_hidden = is_hidden || hidden != nullptr;
    auto* value = hidden != nullptr ? const_cast<llvm::Constant*>(hidden) : llvm::dyn_cast<llvm::Constant>(operand);
    if (value == nullptr) return {};
    operands.push_back(value);
  }
  if (!is_hidden) operands.clear();
  return operands;
}

}  // namespace

llvm::Constant* fold_constants(const llvm::Instruction& at, llvm::ArrayRef<llvm::Constant*> operands) {
  const llvm::DataLayout& layout = at.getModule()->getDataLayout();
  if (const auto* comparison = llvm::dyn_cast<llvm::CmpInst>(&at))
    return llvm::ConstantFoldCompareInstOperands(comparison->getPredicate(), operands[0], operands[1], layout);
  return llvm::ConstantFoldInstOperands(const_cast<llvm::Instruction*>(&at), operands, layout);
}

void fold_power_up(llvm::Function& function) {
  const llvm::DominatorTree dominators(function);
  const llvm::LoopInfo loops(dominators);
  // State that nothing changes: what stands in a loop in its place is a constant.
  for (llvm::Instruction& at : llvm::instructions(function)) {
    if (const llvm::Constant* value = power_up_value(&at))
      at.replaceUsesWithIf(const_cast<llvm::Constant*>(value), [&](const llvm::Use& use) {
        const auto* user = llvm::cast<llvm::Instruction>(use.getUser());
        return !llvm::isa<llvm::PHINode>(user) && loops.getLoopFor(user->getParent()) != nullptr;
      });
  }
  bool changed = true;
  while (changed) {
    changed = false;
    std::vector<llvm::Instruction*> instructions;
    for (llvm::Instruction& at : llvm::instructions(function)) instructions.push_back(&at);
    for (llvm::Instruction* at : instructions) {
      if (power_up_value(at) != nullptr && at->use_empty()) {
        at->eraseFromParent();
        continue;
      }
      if (llvm::isa<llvm::PHINode>(at) || at->isTerminator() || !at->getType()->isIntegerTy() ||
          at->mayHaveSideEffects())
        continue;
      const llvm::SmallVector<llvm::Constant*> operands = operands_at_power_up(*at);
      if (operands.empty()) continue;
      llvm::Constant* const value = fold_constants(*at, operands);
      if (value == nullptr || !llvm::isa<llvm::ConstantInt>(value)) continue;
      llvm::IRBuilder<> builder(at);
      at->replaceAllUsesWith(make_power_up(builder, value));
      at->eraseFromParent();
      changed = true;
    }
  }
}

}  // namespace epiline::frontend
