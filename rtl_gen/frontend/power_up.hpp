#pragma once

#include <llvm/ADT/ArrayRef.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instruction.h>

namespace epiline::frontend {

/// Computes what depends on nothing but values at power-up (vocabulary.hpp): the optimiser may hand a loop an extended
/// or a changed initial value, and that is a value at power-up, too.
void fold_power_up(llvm::Function& function);

/// What an instruction without side effects computes of constants; null if that is no constant.
[[nodiscard]] llvm::Constant* fold_constants(const llvm::Instruction& at, llvm::ArrayRef<llvm::Constant*> operands);

}  // namespace epiline::frontend
