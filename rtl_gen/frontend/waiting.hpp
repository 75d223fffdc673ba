#pragma once

#include <llvm/IR/Function.h>

#include "frontend/function_passes.hpp"

namespace epiline::frontend {

/// Sources for other tools ask before they read: `if (!in.empty()) { ... in.read() ... }`, `if (in.read_nb(x)) ...`.
/// Natively a call that finds nothing returns, and is made again; hardware waits. Both give the same tokens where a
/// call in which the stream is empty (or full) does nothing at all: no other stream is accessed and no state changes,
/// before or after the question, and a stream that was asked whether it is empty is read on every way from there. Such
/// questions get the answer "no" here, since the read waits; others are refused. In a loop without an end the same has
/// to hold of a pass, which leaves the loop's variables as they are. `while (!in.empty())` is such a loop where no
/// variable lives from one pass to the next. Before the first of LLVM's passes that rearrange code.
///
/// In a process of a DATAFLOW region (`is_part`) that takes scalars all are refused: which call's scalars a token meets
/// would depend on timing.
void wait_instead_of_asking(llvm::Function& process, analysis_managers& managers, bool is_part);

}  // namespace epiline::frontend
