#pragma once

#include <llvm/IR/Module.h>

#include <functional>
#include <set>
#include <vector>

namespace epiline::frontend {

/// The functions, one a variable, that compute initial values before a program's main function.
[[nodiscard]] std::vector<llvm::Function*> start_up_functions(llvm::Module& module);

/// Runs these functions: the values they compute become their variables' contents, since hardware has no such moment.
/// Everything must be inlined into them; a loop is run only when it is unrolled. Returns the variables whose initial
/// values cannot be computed here; a top that uses one of them must be refused.
[[nodiscard]] std::set<const llvm::GlobalVariable*> run_start_up_code(llvm::Module& module,
                                                                      const std::vector<llvm::Function*>& functions);

}  // namespace epiline::frontend
