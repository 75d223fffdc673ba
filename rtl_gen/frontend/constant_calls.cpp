#include "frontend/constant_calls.hpp"

#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/compile_time.hpp"

namespace epiline::frontend {

void compute_constant_calls(llvm::Module& module) {
  const auto is_constant = [](const llvm::Use& argument) { return llvm::isa<llvm::ConstantInt>(argument); };
  std::vector<llvm::CallInst*> calls;
  for (llvm::Function* function : recursive_functions(module))
    for (llvm::CallInst* call : calls_of(module, function->getName()))
      if (call->getType()->isIntegerTy() && std::all_of(call->arg_begin(), call->arg_end(), is_constant))
        calls.push_back(call);
  for (llvm::CallInst* call : calls) {
    llvm::Constant* const result = compile_time_run(module).result_of(*call);
    if (result == nullptr) continue;
    call->replaceAllUsesWith(result);
    call->eraseFromParent();
  }
}

}  // namespace epiline::frontend
