#include "frontend/start_up.hpp"

#include <llvm/Analysis/TargetLibraryInfo.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/TargetParser/Triple.h>
#include <llvm/Transforms/Utils/Evaluator.h>

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

std::set<const llvm::GlobalVariable*> run_start_up_code(llvm::Module& module,
                                                        const std::vector<llvm::Function*>& functions) {
  std::set<const llvm::GlobalVariable*> unknown;
  llvm::TargetLibraryInfoImpl library(llvm::Triple(module.getTargetTriple()));
  const llvm::TargetLibraryInfo known(library);
  for (llvm::Function* start : functions) {
    if (start->isDeclaration()) continue;
    llvm::Evaluator evaluator(module.getDataLayout(), &known);
    llvm::Constant* ignored = nullptr;
    if (evaluator.EvaluateFunction(start, ignored, llvm::SmallVector<llvm::Constant*, 0>())) {
      for (const auto& [variable, value] : evaluator.getMutatedInitializers()) variable->setInitializer(value);
      for (llvm::GlobalVariable* variable : evaluator.getInvariants()) variable->setConstant(true);
      continue;
    }
    for (const llvm::Instruction& instruction : llvm::instructions(*start))
      for (const llvm::Use& operand : instruction.operands())
        if (const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(operand->stripInBoundsConstantOffsets()))
          unknown.insert(variable);
  }
  return unknown;
}

}  // namespace epiline::frontend
