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
  std::uint64_t offset;  // in the element, in bytes
};

/// All accesses of `array` by `function`, one after another in one place that goes through the elements in order, each
/// once, whenever the function or a pass through its endless loop is done: reads only, or writes of whole elements.
/// Empty when that is not known. `array` has `count` elements, whatever its dimensions.
[[nodiscard]] std::vector<element_access> accesses_in_order(llvm::Value& array, llvm::Type& element,
                                                            std::uint64_t count, llvm::Function& function,
                                                            llvm::FunctionAnalysisManager& analyses);

}  // namespace epiline::frontend
