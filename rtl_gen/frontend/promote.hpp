#pragma once

#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>

#include <vector>

namespace epiline::frontend {

/// Makes SSA values of variables that are loaded and stored as a whole.
void promote(llvm::Function& function, const std::vector<llvm::AllocaInst*>& scalars);

}  // namespace epiline::frontend
