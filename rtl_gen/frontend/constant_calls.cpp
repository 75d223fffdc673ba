#include "frontend/constant_calls.hpp"

#include <llvm/ADT/SCCIterator.h>
#include <llvm/Analysis/CallGraph.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <set>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/compile_time.hpp"

namespace epiline::frontend {

namespace {

std::set<const llvm::Function*> recursive_functions(llvm::Module& module) {
  std::set<const llvm::Function*> found;
  llvm::CallGraph calls(module);
  for (auto component = llvm::scc_begin(&calls); !component.isAtEnd(); ++component)
    if (component.hasCycle())
      for (const llvm::CallGraphNode* node : *component)
        if (node->getFunction() != nullptr && !node->getFunction()->isDeclaration()) found.insert(node->getFunction());
  return found;
}

}  // namespace

void compute_constant_calls(llvm::Module& module) {
  const std::set<const llvm::Function*> recursive = recursive_functions(module);
  if (recursive.empty()) return;
  std::vector<llvm::CallInst*> calls;
  for (llvm::Function& function : module)
    for (llvm::Instruction& instruction : llvm::instructions(function))
      if (recursive.count(called_by(instruction)) != 0)
        if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
            call != nullptr && call->getType()->isIntegerTy() &&
            std::all_of(call->arg_begin(), call->arg_end(),
                        [](const llvm::Use& argument) { return llvm::isa<llvm::ConstantInt>(argument); }))
          calls.push_back(call);
  for (llvm::CallInst* call : calls) {
    llvm::Constant* const result = compile_time_run(module).result_of(*call);
    if (result == nullptr) continue;
    call->replaceAllUsesWith(result);
    call->eraseFromParent();
  }
}

}  // namespace epiline::frontend
