#include "frontend/promote.hpp"

#include <llvm/ADT/DenseMap.h>
#include <llvm/ADT/DenseSet.h>
#include <llvm/ADT/STLExtras.h>
#include <llvm/IR/BasicBlock.h>
#include <llvm/IR/Dominators.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>

namespace epiline::frontend {

namespace {

using variables = llvm::DenseSet<const llvm::Value*>;

/// Leaves one load and one store of a variable in a block at most: the load of what the blocks before left, at the
/// block's beginning, and the last store.
void promote_in(llvm::BasicBlock& block, const variables& scalars) {
  llvm::DenseMap<const llvm::Value*, llvm::Value*> current;
  llvm::DenseMap<const llvm::Value*, llvm::StoreInst*> last_store;
  std::vector<llvm::LoadInst*> first_loads;
  for (llvm::Instruction& instruction : llvm::make_early_inc_range(block)) {
    const llvm::Value* const variable = llvm::getLoadStorePointerOperand(&instruction);
    if (variable == nullptr || !scalars.contains(variable)) continue;
    if (auto* load = llvm::dyn_cast<llvm::LoadInst>(&instruction)) {
      const auto [known, is_first] = current.try_emplace(variable, load);
      if (is_first) {
        first_loads.push_back(load);
      } else {
        load->replaceAllUsesWith(known->second);
        load->eraseFromParent();
      }
    } else {
      auto* store = llvm::cast<llvm::StoreInst>(&instruction);
      current[variable] = store->getValueOperand();
      llvm::StoreInst*& last = last_store[variable];
      if (last != nullptr) last->eraseFromParent();
      last = store;
    }
  }
  const auto begin = block.getFirstInsertionPt();
  for (llvm::LoadInst* load : first_loads)
    if (&*begin != load) load->moveBefore(block, begin);
}

}  // namespace

void promote(llvm::Function& function, const std::vector<llvm::AllocaInst*>& scalars) {
  // For each variable LLVM looks through every block that loads it, from the beginning to the first access: with
  // thousands of variables in blocks of ten thousands of instructions that takes longer than all the rest.
  const variables set(scalars.begin(), scalars.end());
  for (llvm::BasicBlock& block : function) promote_in(block, set);
  llvm::DominatorTree dominators(function);
  llvm::PromoteMemToReg(scalars, dominators);
}

}  // namespace epiline::frontend
