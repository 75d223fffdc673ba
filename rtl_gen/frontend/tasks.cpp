#include "frontend/tasks.hpp"

#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/source.hpp"
#include "frontend/stream_types.hpp"

namespace epiline::frontend {

namespace {

/// Whether it is a constructor of hls::task.
bool makes_tasks(const llvm::Function& function) { return function.getName().starts_with("_ZN3hls4taskC"); }

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
  std::vector<std::string> constructors;
  for (const llvm::Function& function : module)
    if (makes_tasks(function)) constructors.push_back(function.getName().str());
  for (const std::string& constructor : constructors)
    for (llvm::CallInst* made : calls_of(module, constructor)) call_task(*made);
}

}  // namespace epiline::frontend
