#pragma once
// Where and how a variable is accessed: every address that is made of it is followed to the scalars read and written.

#include <llvm/IR/DataLayout.h>
#include <llvm/IR/Instructions.h>

#include <utility>
#include <vector>

#include "frontend/variables.hpp"

namespace epiline::frontend {

struct scalar_access {
  llvm::Instruction* instruction;  // load or store
  path_steps path;
};

struct variable_accesses {
  std::vector<scalar_access> accesses;
  std::vector<std::pair<path_steps, llvm::CallInst*>> pragmas;
  std::vector<llvm::Instruction*> dead;  // when the accesses are gone; users before their operands
};

/// An access of several scalars at once is taken apart into one for each. Refuses pointers chosen at run time,
/// addresses that escape and type punning.
[[nodiscard]] variable_accesses collect_accesses(const variable& of, const llvm::DataLayout& layout);

}  // namespace epiline::frontend
