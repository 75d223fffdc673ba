#pragma once
// Arrays of which each element is accessed once and in order: they need no memory.

#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/PassManager.h>

#include <vector>

namespace epiline::frontend {

/// An access of an element, or of a member of it, by a load, a store or a stream's token.
struct element_access {
  llvm::Use* pointer;
  std::uint64_t offset;  // in the elements of a pass, in bytes
};

struct ordered_accesses {
  std::vector<element_access> all;  // in one block, in the order in which they take place
  std::uint64_t elements = 0;       // that a pass through it accesses
};

/// The accesses of `array` by `function` if each pass through one place accesses the next elements, and all of them
/// have been accessed whenever the function or a pass through its endless loop is done: reads only, or writes of whole
/// elements. None when that is not known. `array` has `count` elements, whatever its dimensions.
[[nodiscard]] ordered_accesses accesses_in_order(llvm::Value& array, llvm::Type& element, std::uint64_t count,
                                                 llvm::Function& function, llvm::FunctionAnalysisManager& analyses);

}  // namespace epiline::frontend
