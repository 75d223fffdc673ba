#pragma once
// Variables of a top with DATAFLOW that one process writes and others use. Every process is a copy of the top without
// the other calls (see processes.hpp) and has a copy of the variable: where the writer's call stands, its value goes
// through a FIFO into the copies of those that use it, an array element by element. So each process sees what it would
// see in the sequential program.

#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/Utils/ValueMapper.h>

#include <cstddef>
#include <set>
#include <vector>

namespace epiline::frontend {

/// What a process gives another one that uses the variable.
struct shared_variable {
  llvm::AllocaInst* slot = nullptr;
  std::size_t writer = 0;              // the number of its call
  std::size_t reader = 0;              // the number of a call that uses what was written
  llvm::Instruction* after = nullptr;  // the value is there behind it: the writer's call, or the store of its result
  llvm::GlobalVariable* channel = nullptr;  // stands for the stream between them
  llvm::GlobalVariable* type = nullptr;     // of one token: the variable's, or that of an array's elements
  bool is_kept = false;                     // the top puts it, or what is computed of it, into what outlives the call
};

/// Gives the integers that calls return to variables, as if they were passed by reference. Returns where the value of
/// each call is there: behind the call itself, or behind the store of its result.
std::vector<llvm::Instruction*> keep_results(llvm::Function& top, const std::vector<llvm::CallInst*>& calls);

/// Finds the local variables of the top that are scalars, small structures or arrays of them, are written by processes
/// and used by others; `except` may not be among them. Makes the globals. `calls` are the processes.
[[nodiscard]] std::vector<shared_variable> find_shared_variables(llvm::Function& top,
                                                                 const std::vector<llvm::CallInst*>& calls,
                                                                 const std::vector<llvm::Instruction*>& after,
                                                                 const std::set<const llvm::Value*>& except);

/// In the copy of the module for process `process`: writes what it gives to others, reads what it gets of others.
/// `copies` leads to the copies, in which all calls are still there.
void pass_shared_variables(const std::vector<shared_variable>& shared, std::size_t process,
                           llvm::ValueToValueMapTy& copies);

}  // namespace epiline::frontend
