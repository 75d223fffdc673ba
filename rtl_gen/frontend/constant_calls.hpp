#pragma once

#include <llvm/IR/Module.h>

namespace epiline::frontend {

/// `value >> log2_of(64)`: what a function that calls itself returns for numbers that the source gives takes the place
/// of the call, as that of a constant expression. Calls with other arguments stay, and so do functions that look at or
/// write anything but their own variables and constants.
void compute_constant_calls(llvm::Module& module);

}  // namespace epiline::frontend
