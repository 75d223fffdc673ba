#pragma once

#include <llvm/IR/Function.h>

namespace epiline::frontend {

/// Writes out arithmetic that tells whether its result fits, and signed arithmetic that stays at the largest or
/// smallest number instead, in a type that holds every result. Compilers' builtins (__builtin_add_overflow) are made of
/// it, and the optimiser makes it of comparisons: 255 < a * b, clamped sums.
void write_out_overflow(llvm::Function& function);

}  // namespace epiline::frontend
