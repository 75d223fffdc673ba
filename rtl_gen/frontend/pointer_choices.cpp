#include "frontend/pointer_choices.hpp"

#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include <vector>

namespace epiline::frontend {

namespace {

using llvm::Instruction;
using llvm::Value;

/// Whether memory may change between a phi and a later instruction of its block.
bool writes_between(const llvm::PHINode& from, const Instruction& to) {
  if (from.getParent() != to.getParent()) return true;
  for (const Instruction* at = from.getNextNode(); at != &to; at = at->getNextNode())
    if (at == nullptr || at->mayWriteToMemory()) return true;
  return false;
}

/// The phi that chooses among addresses; not one that steps through an array, pass by pass of a loop.
llvm::PHINode* pointer_phi(Value* pointer, const llvm::DominatorTree& dominators) {
  auto* phi = llvm::dyn_cast<llvm::PHINode>(pointer);
  if (phi == nullptr || !phi->getType()->isPointerTy()) return nullptr;
  for (const llvm::BasicBlock* from : phi->blocks())
    if (dominators.dominates(phi->getParent(), from)) return nullptr;
  return phi;
}

/// Whether a getelementptr can be made anew at the end of each block the phi comes from.
bool indices_available(const llvm::GetElementPtrInst& element) { return element.hasAllConstantIndices(); }

Value* element_of(llvm::IRBuilderBase& builder, const llvm::GetElementPtrInst& like, Value* base) {
  const std::vector<Value*> indices(like.idx_begin(), like.idx_end());
  return builder.CreateGEP(like.getSourceElementType(), base, indices, "", like.isInBounds());
}

/// Replaces an instruction that takes its address from a phi by a phi of that instruction on each address.
template <class Make>
void spread_over_phi(Instruction& user, llvm::PHINode& phi, const Make& make) {
  llvm::IRBuilder<> builder(&phi);
  llvm::PHINode* const values = builder.CreatePHI(user.getType(), phi.getNumIncomingValues());
  values->setDebugLoc(user.getDebugLoc());
  std::vector<std::pair<llvm::BasicBlock*, Value*>> made;  // one value a block, however often it comes
  for (unsigned i = 0; i < phi.getNumIncomingValues(); ++i) {
    llvm::BasicBlock* const from = phi.getIncomingBlock(i);
    Value* value = nullptr;
    for (const auto& [block, known] : made)
      if (block == from) value = known;
    if (value == nullptr) {
      builder.SetInsertPoint(from->getTerminator());
      builder.SetCurrentDebugLocation(user.getDebugLoc());
      value = make(builder, phi.getIncomingValue(i));
      made.emplace_back(from, value);
    }
    values->addIncoming(value, from);
  }
  user.replaceAllUsesWith(values);
  user.eraseFromParent();
}

/// One step on one instruction; returns whether it changed (and may be gone).
bool resolve(Instruction& user, const llvm::DominatorTree& dominators) {
  if (auto* load = llvm::dyn_cast<llvm::LoadInst>(&user)) {
    if (llvm::PHINode* phi = pointer_phi(load->getPointerOperand(), dominators);
        phi != nullptr && !writes_between(*phi, *load)) {
      spread_over_phi(*load, *phi, [&](llvm::IRBuilderBase& builder, Value* from) {
        return builder.CreateLoad(load->getType(), from);
      });
      return true;
    }
    if (auto* choice = llvm::dyn_cast<llvm::SelectInst>(load->getPointerOperand())) {
      llvm::IRBuilder<> builder(load);
      Value* const one = builder.CreateLoad(load->getType(), choice->getTrueValue());
      Value* const zero = builder.CreateLoad(load->getType(), choice->getFalseValue());
      load->replaceAllUsesWith(builder.CreateSelect(choice->getCondition(), one, zero));
      load->eraseFromParent();
      return true;
    }
  } else if (auto* element = llvm::dyn_cast<llvm::GetElementPtrInst>(&user)) {
    if (llvm::PHINode* phi = pointer_phi(element->getPointerOperand(), dominators);
        phi != nullptr && phi->getParent() == element->getParent() && indices_available(*element)) {
      spread_over_phi(*element, *phi,
                      [&](llvm::IRBuilderBase& builder, Value* from) { return element_of(builder, *element, from); });
      return true;
    }
    if (auto* choice = llvm::dyn_cast<llvm::SelectInst>(element->getPointerOperand())) {
      llvm::IRBuilder<> builder(element);
      Value* const one = element_of(builder, *element, choice->getTrueValue());
      Value* const zero = element_of(builder, *element, choice->getFalseValue());
      element->replaceAllUsesWith(builder.CreateSelect(choice->getCondition(), one, zero));
      element->eraseFromParent();
      return true;
    }
  } else if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&user)) {
    auto* choice = llvm::dyn_cast<llvm::SelectInst>(store->getPointerOperand());
    if (choice == nullptr) return false;
    llvm::IRBuilder<> builder(store);
    Value* const value = store->getValueOperand();
    for (const bool taken : {true, false}) {
      Value* const target = taken ? choice->getTrueValue() : choice->getFalseValue();
      Value* const old = builder.CreateLoad(value->getType(), target);
      builder.CreateStore(taken ? builder.CreateSelect(choice->getCondition(), value, old)
                                : builder.CreateSelect(choice->getCondition(), old, value),
                          target);
    }
    store->eraseFromParent();
    return true;
  }
  return false;
}

}  // namespace

void resolve_pointer_choices(llvm::Function& function) {
  const llvm::DominatorTree dominators(function);  // the control flow stays as it is
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<Instruction*> users;
    for (Instruction& instruction : llvm::instructions(function))
      if (llvm::isa<llvm::LoadInst, llvm::StoreInst, llvm::GetElementPtrInst>(instruction))
        users.push_back(&instruction);
    for (Instruction* user : users) changed = resolve(*user, dominators) || changed;
    // Choices without users left would still look like escaping addresses.
    std::vector<Instruction*> unused;
    for (Instruction& instruction : llvm::instructions(function))
      if (llvm::isa<llvm::PHINode, llvm::SelectInst, llvm::GetElementPtrInst>(instruction) && instruction.use_empty() &&
          instruction.getType()->isPointerTy())
        unused.push_back(&instruction);
    for (Instruction* instruction : unused) instruction->eraseFromParent();
    changed = changed || !unused.empty();
  }
}

}  // namespace epiline::frontend
