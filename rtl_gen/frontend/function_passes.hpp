#pragma once
// LLVM's own passes as the frontend uses them: inlining, and the clean-ups between its own steps.

#include <llvm/IR/Function.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/PassManager.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Transforms/Utils/SimplifyCFGOptions.h>

#include <vector>

namespace epiline::frontend {

struct analysis_managers {
  llvm::LoopAnalysisManager loop;
  llvm::FunctionAnalysisManager function;
  llvm::CGSCCAnalysisManager cgscc;
  llvm::ModuleAnalysisManager module;

  analysis_managers();
};

/// Inlines every call in the roots except calls of roots, and in nothing else that matters.
void inline_everything(llvm::Module& module, const std::vector<llvm::Function*>& roots, analysis_managers& managers);

/// No lookup tables, no merging of accesses across branches: both would make addresses into values.
[[nodiscard]] llvm::SimplifyCFGOptions plain_control_flow();

void run_passes(llvm::Function& function, analysis_managers& managers, llvm::FunctionPassManager passes);

/// Variables become SSA values where possible; nothing is rearranged.
[[nodiscard]] llvm::FunctionPassManager early_cleanup();

/// What is left once ports and memories are calls: equal expressions are one, algebra is done.
[[nodiscard]] llvm::FunctionPassManager late_cleanup();

}  // namespace epiline::frontend
