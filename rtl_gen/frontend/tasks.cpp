#include "frontend/tasks.hpp"

#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/source.hpp"
#include "frontend/stream_types.hpp"

namespace epiline::frontend {

namespace {

bool makes_tasks(const llvm::Function& function) {
  return llvm::StringRef(readable_name(function)).starts_with("hls::task::task<");
}

/// The task itself and its function come before the streams.
void call_task(llvm::CallInst& made) {
  auto* const function = llvm::dyn_cast<llvm::Function>(made.getArgOperand(1)->stripPointerCasts());
  if (function == nullptr)
    refuse(place_of(made), "hls::task: its function is known only at run time: name the function");
  const std::vector<llvm::Value*> streams(std::next(made.arg_begin(), 2), made.arg_end());
  const bool fits = function->arg_size() == streams.size() &&
                    std::all_of(function->arg_begin(), function->arg_end(), [](const llvm::Argument& argument) {
                      return argument.getType()->isPointerTy() && !argument.hasByValAttr();
                    });
  if (!fits || !takes_streams(*function))
    refuse(place_of(made), "hls::task: its function takes more than streams: give it streams by reference only");
  auto* const call = llvm::CallInst::Create(function, streams, "", made.getIterator());
  call->setDebugLoc(made.getDebugLoc());
  made.eraseFromParent();
}

}  // namespace

bool has_tasks(const llvm::Module& module) { return std::any_of(module.begin(), module.end(), makes_tasks); }

void call_tasks(llvm::Module& module) {
  if (!has_tasks(module)) return;
  std::vector<llvm::CallInst*> made;
  for (llvm::Function& function : module)
    for (llvm::Instruction& instruction : llvm::instructions(function))
      if (const llvm::Function* const callee = called_by(instruction); callee != nullptr && makes_tasks(*callee))
        made.push_back(llvm::cast<llvm::CallInst>(&instruction));
  for (llvm::CallInst* one : made) call_task(*one);
}

}  // namespace epiline::frontend
