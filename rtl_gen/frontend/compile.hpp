#pragma once
// Runs clang on the user's source: C++ in, LLVM IR of "the top, called for ever" out.

#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace epiline::frontend {

/// The function of the IR that calls the top for ever. While a module holds several tops, it is that of the first.
inline constexpr const char* process_name = "__epiline_process";

struct source_options {
  std::string source;                                       // the C++ file that defines the top
  std::string top;                                          // its name
  std::vector<std::string> includes;                        // -I
  std::vector<std::string> definitions;                     // -D
  std::function<void(const std::string&)> on_preprocessed;  // gets the source with everything it includes; may be empty
};

struct compiled_source {
  std::unique_ptr<llvm::Module> module;   // the functions of which are read when keep_top says so
  std::vector<std::string> notes;         // about pragmas, one line each
  std::vector<std::string> dependencies;  // every file read
};

/// The first line of the source that names the top followed by a parenthesis; 1 when there is none.
[[nodiscard]] unsigned line_of_top(const source_options& options);

/// Compiles the source once for all these tops, one of which keep_top has to choose; `options` need not name one.
/// Throws `refused` with clang's own message when the source does not compile, and when there is no such file or top.
[[nodiscard]] compiled_source compile(const source_options& options, const std::vector<std::string>& tops,
                                      llvm::LLVMContext& context);

/// Reads the functions of the module. Of several tops it leaves what the one of this number and the program's start-up
/// need.
void keep_top(llvm::Module& module, std::size_t number);

}  // namespace epiline::frontend
