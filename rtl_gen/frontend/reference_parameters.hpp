#pragma once
// The top's scalars by reference, behind pointers and in arrays: what it only reads it is given.

#include <llvm/IR/Function.h>

#include "frontend/top_function.hpp"

namespace epiline::frontend {

/// Makes arguments of the results of `process`, the call of the top, that nothing writes. Everything is inlined but
/// functions that are processes themselves. Refuses pointers that are used for more than the value they point at.
void pass_what_is_read(llvm::Function& process, const top_description& top);

}  // namespace epiline::frontend
