#pragma once
// Long arrays that the top takes: streams of their elements.

#include <llvm/IR/Function.h>
#include <llvm/IR/PassManager.h>

#include <string>
#include <vector>

#include "frontend/top_function.hpp"

namespace epiline::frontend {

/// Decides which way the elements of each array go: into the call when the top reads it, out of it when the top writes
/// it; what it reads of an array that it writes must be its own, written before. An array that is accessed in order is
/// no array any more but accesses of the stream. `process` is the call of the top, in which everything is inlined but
/// functions that are processes; where there are such the other arrays are variables of the top, which they give each
/// other. Returns whether there are any arrays; adds a note for each that takes memory.
/// Refuses an array that is both given and changed.
bool connect_data_arrays(llvm::Function& process, const top_description& top, llvm::FunctionAnalysisManager& analyses,
                         bool has_processes, std::vector<std::string>& notes);

}  // namespace epiline::frontend
