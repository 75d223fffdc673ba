#include "frontend/machine_start.hpp"

#include <llvm/IR/Instructions.h>

#include <algorithm>

#include "frontend/power_up.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

using llvm::BasicBlock;
using llvm::Instruction;

namespace {

bool is_pure(const BasicBlock& block) {
  return std::all_of(block.begin(), block.end(), [](const Instruction& at) { return access_of(at) == access::none; });
}

}  // namespace

machine_start::machine_start(const step_structure& steps, const step_flow& flow, const live_values& live)
    : steps_(steps), flow_(flow), first_(steps.cuts.front()) {
  const BasicBlock* next = first_;
  do {
    path_.push_back(next);
    if (!is_pure(*next)) return;
    next = next->getSingleSuccessor();
  } while (next != nullptr && !steps_.is_cut(next));
  if (next == nullptr) return;
  path_.push_back(next);
  if (can_start_at(*next, live)) first_ = next;
}

bool machine_start::can_start_at(const BasicBlock& cut, const live_values& live) const {
  const BasicBlock& entry = *path_.front();
  const bool is_kept_at_reset =
      std::any_of(entry.begin(), entry.end(), [](const Instruction& at) { return power_up_value(&at) != nullptr; });
  // More than constants that the cut itself chooses only where it must be: a step that sets state would do so after
  // each reset.
  const BasicBlock* const last = *std::prev(path_.end(), 2);
  for (const llvm::PHINode& phi : cut.phis())
    if (is_kept_at_reset ? value_of(&phi).number == nullptr
                         : !llvm::isa<llvm::Constant>(phi.getIncomingValueForBlock(last)))
      return false;
  for (const Instruction* value : live[steps_.cut_number.at(&cut)]) {
    const bool is_of_cut = steps_.is_cut_phi(value) && value->getParent() == &cut;
    if (!is_of_cut && (!is_kept_at_reset || value_of(value).number == nullptr)) return false;
  }
  return true;
}

start_value machine_start::value_of(const llvm::Value* value) const {
  if (auto* number = llvm::dyn_cast<llvm::Constant>(value)) return {const_cast<llvm::Constant*>(number), false};
  if (const llvm::Constant* number = power_up_value(value)) return {const_cast<llvm::Constant*>(number), true};
  const auto* at = llvm::dyn_cast<Instruction>(value);
  if (at == nullptr) return {};
  const auto home = std::find(path_.begin(), path_.end(), at->getParent());
  if (home == path_.end()) return {};
  if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(at))
    return home == path_.begin() ? start_value() : value_of(phi->getIncomingValueForBlock(*std::prev(home)));
  if (!at->getType()->isIntegerTy() || at->mayReadOrWriteMemory()) return {};
  start_value result;
  llvm::SmallVector<llvm::Constant*> operands;
  for (const llvm::Value* operand : at->operands()) {
    const start_value of_operand = value_of(operand);
    if (of_operand.number == nullptr) return {};
    operands.push_back(of_operand.number);
    result.is_kept_at_reset |= of_operand.is_kept_at_reset;
  }
  result.number = fold_constants(*at, operands);
  return result;
}

bool machine_start::runs(const BasicBlock* block) const {
  for (unsigned cut = 0; cut < steps_.cuts.size(); ++cut)
    if (runs(cut) && flow_.reaches(steps_.cuts[cut], block)) return true;
  return false;
}

bool machine_start::only_in_patient_steps(const BasicBlock* block) const {
  if (steps_.patient_cut < 0) return false;
  for (unsigned cut = 0; cut < steps_.cuts.size(); ++cut)
    if (runs(cut) && static_cast<int>(cut) != steps_.patient_cut && flow_.reaches(steps_.cuts[cut], block))
      return false;
  return true;
}

}  // namespace epiline::frontend
