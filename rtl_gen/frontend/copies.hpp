#pragma once

#include <llvm/IR/Function.h>

namespace epiline::frontend {

/// What to do with a copy whose type is not known: SROA understands some of them.
enum class unknown_types { kept, refused };

/// Replaces memcpy, memmove and memset of aggregates by loads and stores of their scalars, which the later steps can
/// follow one by one: those of large arrays that are indexed at run time by loops, when `otherwise` is `refused` (until
/// then they stay). Refuses other copies too large to happen in one clock. Changes the control flow.
void expand_copies(llvm::Function& function, unknown_types otherwise);

/// Structs that a calling convention returns in registers are loaded and stored as a whole: makes scalars of them.
void split_whole_structs(llvm::Function& function);

}  // namespace epiline::frontend
