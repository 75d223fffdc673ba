#pragma once

#include <llvm/IR/Module.h>

#include <set>
#include <vector>

namespace epiline::frontend {

/// The functions, one a variable, that compute initial values before a program's main function.
[[nodiscard]] std::vector<llvm::Function*> start_up_functions(llvm::Module& module);

/// C++ notes in a variable whether a static variable of a function has its first value: of that variable, eight bytes
/// in templates, the first byte alone is used.
void narrow_guards(llvm::Module& module);

/// Runs what a program runs before its main function: the values it computes become their variables' contents, since
/// hardware has no such moment. Returns the variables whose initial values cannot be computed here; a top that uses one
/// of them must be refused.
[[nodiscard]] std::set<const llvm::GlobalVariable*> run_start_up_code(llvm::Module& module);

}  // namespace epiline::frontend
