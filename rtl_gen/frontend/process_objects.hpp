#pragma once
// Processes run side by side: they may be joined by streams only. Finds the variables that would join them otherwise.

#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>

#include <map>
#include <set>
#include <vector>

namespace epiline::frontend {

/// Whether a function, or what it calls, writes through a pointer: one that it is given, or that to a variable of its
/// own. That the call of the top passes the variable is no writing.
[[nodiscard]] bool is_written_through(const llvm::Value& pointer);

/// Looks at every variable that the processes, which are `calls` in `top`, are given by reference or use as a static or
/// global one; `streams` are the objects that may be shared. Everything is inlined but these calls.
/// Refuses a variable that one process writes and anybody else uses. Returns who writes the variables of the top.
[[nodiscard]] std::map<const llvm::Value*, std::size_t> check_objects(const llvm::Function& top,
                                                                      const std::vector<llvm::CallInst*>& calls,
                                                                      const std::set<const llvm::Value*>& streams);

}  // namespace epiline::frontend
