#pragma once
// Makes LLVM IR of the frontend executable: its accesses of streams, memories and tables become calls and variables of
// a program, which check/include/epiline/check_ir.hpp runs.

#include <llvm/IR/Module.h>

#include <string>
#include <vector>

#include "frontend/lower.hpp"

namespace epiline::check {

/// The text of what clang made of the source. `module` stays as it is.
[[nodiscard]] std::string executable_source(const llvm::Module& module);

struct lowered_text {
  std::string text;
  std::vector<frontend::source_place> writes;  // source lines, by the number a write gives less 1
};

/// The name of the function that is process number `process` in the texts.
[[nodiscard]] std::string process_function(std::size_t process);

/// The text of a lowered process.
[[nodiscard]] lowered_text executable_process(const frontend::lowered_process& lowered, std::size_t process);

}  // namespace epiline::check
