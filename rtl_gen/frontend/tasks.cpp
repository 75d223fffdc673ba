#include "frontend/tasks.hpp"

#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/source.hpp"
#include "frontend/stream_types.hpp"

namespace epiline::frontend {

namespace {

/// Whether it gives an hls::task its function: a constructor, or the operator of one that was made without.
bool starts_tasks(const llvm::Function& function) {
  const llvm::StringRef name = function.getName();
  return name.starts_with("_ZN3hls4taskC1I") || name.starts_with("_ZN3hls4taskC2I") ||
         name.starts_with("_ZN3hls4taskclI");
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

bool has_tasks(const llvm::Module& module) { return std::any_of(module.begin(), module.end(), starts_tasks); }

std::set<const llvm::Function*> call_tasks(llvm::Module& module) {
  std::vector<std::string> starts;
  for (const llvm::Function& function : module)
    if (starts_tasks(function)) starts.push_back(function.getName().str());
  std::set<const llvm::Function*> callers;
  for (const std::string& start : starts)
    for (llvm::CallInst* made : calls_of(module, start)) {
      callers.insert(made->getFunction());
      call_task(*made);
    }
  return callers;
}

}  // namespace epiline::frontend
