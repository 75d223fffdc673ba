#pragma once
// What the source must not contain, looked for where it still looks like the user's code. All throw `refused`.

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>

#include <set>

namespace epiline::frontend {

/// Before anything is inlined: what the inliner could not take in (recursion, functions with `...`, computed gotos,
/// setjmp), in everything that `process` calls.
void check_functions(llvm::Module& module, const llvm::Function& process);

/// When everything is inlined: calls that are left, and variables and operations without a form in hardware.
void check_operations(const llvm::Function& process);

/// Loops that neither end nor access a stream. Before code behind them is removed, or that would be blamed.
void check_endless_loops(const llvm::LoopInfo& loops);

/// Whether a call says that text or floating point is no number.
[[nodiscard]] bool is_no_number(const llvm::CallInst& call);

/// Such calls that may happen, when everything known is computed.
void refuse_no_numbers(const llvm::Function& process);

/// Variables whose value only running code could tell, where the process uses them.
void check_initial_values(const std::set<const llvm::GlobalVariable*>& unknown, const llvm::Function& process);

/// The number that a pragma gives, which must be a constant from `least` on.
[[nodiscard]] int pragma_number(const llvm::CallInst& call, unsigned argument, int least);

}  // namespace epiline::frontend
