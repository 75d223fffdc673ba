#pragma once
// What must be in registers when a step starts: a cut's phis, and what earlier steps computed and later ones use.

#include <llvm/IR/Instruction.h>

#include <vector>

#include "frontend/step_flow.hpp"

namespace epiline::frontend {

/// The values by cut, each in the order of the program.
using live_values = std::vector<std::vector<const llvm::Instruction*>>;

[[nodiscard]] live_values find_live_values(const step_structure& steps, const step_flow& flow);

}  // namespace epiline::frontend
