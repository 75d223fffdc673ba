#pragma once
// Vendors' sources write some of their processes as loops, or as plain code, in the function with DATAFLOW itself.

#include <llvm/IR/Function.h>

#include <vector>

namespace epiline::frontend {

/// The blocks in the order in which they are run when each is once: those of a loop before what comes behind it.
[[nodiscard]] std::vector<llvm::BasicBlock*> in_order(llvm::Function& function);

/// Makes a function of every loop, and of every run of statements, that accesses streams in `top` beside the calls of
/// `processes`, and returns them. Not of a loop with such a call in it, or in which the same stream is written and
/// read: those inside of it are looked at then. Refuses accesses that cannot be taken out.
[[nodiscard]] std::vector<llvm::Function*> outline_accesses(llvm::Function& top,
                                                            const std::vector<llvm::Function*>& processes);

}  // namespace epiline::frontend
