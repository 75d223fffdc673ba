#include "frontend/function_passes.hpp"

#include <llvm/Transforms/IPO/AlwaysInliner.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/ADCE.h>
#include <llvm/Transforms/Scalar/DCE.h>
#include <llvm/Transforms/Scalar/EarlyCSE.h>
#include <llvm/Transforms/Scalar/InstSimplifyPass.h>
#include <llvm/Transforms/Scalar/SCCP.h>
#include <llvm/Transforms/Scalar/SROA.h>
#include <llvm/Transforms/Scalar/SimplifyCFG.h>

#include <algorithm>

namespace epiline::frontend {

analysis_managers::analysis_managers() {
  llvm::PassBuilder builder;
  builder.registerModuleAnalyses(module);
  builder.registerCGSCCAnalyses(cgscc);
  builder.registerFunctionAnalyses(function);
  builder.registerLoopAnalyses(loop);
  builder.crossRegisterProxies(loop, function, cgscc, module);
}

void inline_everything(llvm::Module& module, const std::vector<llvm::Function*>& roots, analysis_managers& managers) {
  for (llvm::Function& function : module) {
    if (function.isDeclaration()) continue;
    function.removeFnAttr(llvm::Attribute::NoInline);
    function.removeFnAttr(llvm::Attribute::OptimizeNone);
    if (std::find(roots.begin(), roots.end(), &function) != roots.end()) {
      function.removeFnAttr(llvm::Attribute::AlwaysInline);
      continue;
    }
    function.addFnAttr(llvm::Attribute::AlwaysInline);
    if (function.hasComdat()) function.setComdat(nullptr);
    function.setLinkage(llvm::GlobalValue::InternalLinkage);
  }
  llvm::ModulePassManager passes;
  passes.addPass(llvm::AlwaysInlinerPass(false));
  passes.run(module, managers.module);
}

llvm::SimplifyCFGOptions plain_control_flow() {
  return llvm::SimplifyCFGOptions()
      .convertSwitchRangeToICmp(false)
      .convertSwitchToLookupTable(false)
      .needCanonicalLoops(true)
      .hoistCommonInsts(false)
      .sinkCommonInsts(false);
}

void run_passes(llvm::Function& function, analysis_managers& managers, llvm::FunctionPassManager passes) {
  const llvm::PreservedAnalyses preserved = passes.run(function, managers.function);
  managers.function.invalidate(function, preserved);
}

llvm::FunctionPassManager early_cleanup() {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::SROAPass(llvm::SROAOptions::ModifyCFG));
  passes.addPass(llvm::InstSimplifyPass());
  passes.addPass(llvm::SCCPPass());
  passes.addPass(llvm::SimplifyCFGPass(plain_control_flow()));
  passes.addPass(llvm::DCEPass());
  return passes;
}

llvm::FunctionPassManager late_cleanup() {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::EarlyCSEPass(false));
  passes.addPass(llvm::SCCPPass());
  passes.addPass(llvm::InstCombinePass());
  passes.addPass(llvm::SimplifyCFGPass(plain_control_flow()));
  passes.addPass(llvm::EarlyCSEPass(false));
  passes.addPass(llvm::ADCEPass());
  return passes;
}

}  // namespace epiline::frontend
