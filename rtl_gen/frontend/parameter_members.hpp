#pragma once
// Of which numbers the top's parameters are made, as C++ statements: for a testbench that takes tokens apart natively.

#include <llvm/IR/Module.h>

#include <optional>
#include <string>
#include <vector>

namespace epiline::frontend {

/// Statements that call `f` for every number of the object `v`, in the order they have in a token: one entry a
/// parameter of `top`, of a stream for its payload. Empty where the debug information does not tell (a bit-field, a
/// type that is never defined).
[[nodiscard]] std::vector<std::optional<std::string>> parameter_members(llvm::Module& module, const std::string& top);

}  // namespace epiline::frontend
