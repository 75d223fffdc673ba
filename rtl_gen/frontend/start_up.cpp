#include "frontend/start_up.hpp"

#include <llvm/IR/Constants.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include <vector>

#include "frontend/compile_time.hpp"

namespace epiline::frontend {

std::vector<llvm::Function*> start_up_functions(llvm::Module& module) {
  // clang collects the initialisers of a file in one function that calls one function a variable.
  std::vector<llvm::Function*> result;
  const llvm::GlobalVariable* list = module.getGlobalVariable("llvm.global_ctors");
  const auto* entries = list != nullptr ? llvm::dyn_cast<llvm::ConstantArray>(list->getInitializer()) : nullptr;
  if (entries == nullptr) return result;
  for (const llvm::Use& entry : entries->operands()) {
    auto* start =
        llvm::dyn_cast<llvm::Function>(llvm::cast<llvm::ConstantStruct>(entry)->getOperand(1)->stripPointerCasts());
    if (start == nullptr || start->isDeclaration()) continue;
    std::vector<llvm::Function*> called;
    for (llvm::Instruction& instruction : llvm::instructions(*start))
      if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
          call != nullptr && call->getCalledFunction() != nullptr)
        called.push_back(call->getCalledFunction());
    if (start->getName().starts_with("_GLOBAL__"))
      result.insert(result.end(), called.begin(), called.end());
    else
      result.push_back(start);  // of a template's static member
  }
  return result;
}

namespace {

/// What `function` and everything that it calls speaks of.
std::vector<const llvm::GlobalVariable*> variables_of(const llvm::Function& function) {
  std::vector<const llvm::GlobalVariable*> result;
  std::set<const llvm::Function*> seen = {&function};
  std::vector<const llvm::Function*> pending = {&function};
  while (!pending.empty()) {
    const llvm::Function* const at = pending.back();
    pending.pop_back();
    for (const llvm::Instruction& instruction : llvm::instructions(*at))
      for (const llvm::Use& operand : instruction.operands()) {
        const llvm::Value* const used = operand->stripInBoundsConstantOffsets();
        if (const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(used)) result.push_back(variable);
        if (const auto* called = llvm::dyn_cast<llvm::Function>(used); called != nullptr && seen.insert(called).second)
          pending.push_back(called);
      }
  }
  return result;
}

/// Makes what the run has computed the variables' initial contents; false, and nothing changes, where that cannot be.
bool keep_contents(const compile_time_run& run) {
  std::vector<std::pair<llvm::GlobalVariable*, llvm::Constant*>> contents;
  for (const llvm::Value* written : run.written_variables()) {
    auto* variable = const_cast<llvm::GlobalVariable*>(llvm::dyn_cast<llvm::GlobalVariable>(written));
    if (variable == nullptr) return false;
    contents.emplace_back(variable, run.contents_of(*variable, variable->getValueType()));
    if (contents.back().second == nullptr) return false;
  }
  for (const auto& [variable, value] : contents) variable->setInitializer(value);
  for (const llvm::GlobalVariable* variable : run.constant_from_now())
    const_cast<llvm::GlobalVariable*>(variable)->setConstant(true);
  return true;
}

}  // namespace

void narrow_guards(llvm::Module& module) {
  for (llvm::GlobalVariable& guard : llvm::make_early_inc_range(module.globals())) {
    if (!guard.getName().starts_with("_ZGV") || !guard.hasInitializer() || !guard.getInitializer()->isNullValue() ||
        guard.getValueType()->isIntegerTy(8))
      continue;
    llvm::Type* const byte = llvm::Type::getInt8Ty(module.getContext());
    auto* const narrow =
        new llvm::GlobalVariable(module, byte, false, guard.getLinkage(), llvm::ConstantInt::get(byte, 0));
    narrow->takeName(&guard);
    if (guard.hasComdat()) narrow->setComdat(guard.getComdat());
    guard.replaceAllUsesWith(narrow);
    guard.eraseFromParent();
  }
}

std::set<const llvm::GlobalVariable*> run_start_up_code(llvm::Module& module) {
  std::set<const llvm::GlobalVariable*> unknown;
  for (const llvm::Function* start : start_up_functions(module)) {
    compile_time_run run(module);
    if (start->isDeclaration() || (run.run_function(*start) && keep_contents(run))) continue;
    const std::vector<const llvm::GlobalVariable*> used = variables_of(*start);
    unknown.insert(used.begin(), used.end());
  }
  return unknown;
}

}  // namespace epiline::frontend
