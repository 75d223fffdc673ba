#pragma once
// Levels that are programs of this machine: the kernel compiled natively, and the frontend's LLVM IR.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "check/answer.hpp"
#include "check/ir_text.hpp"
#include "dataflow/network.hpp"
#include "frontend/compile.hpp"

namespace epiline::check {

/// What the frontend knows of the top.
struct top_parts {
  frontend::source_options source;
  std::map<unsigned, std::string> parameters;       // names, by index; every stream of an array has one
  std::map<unsigned, int> arrays;                   // sizes, by position in the source; negative: see element_counts
  std::vector<std::optional<std::string>> members;  // of the parameters, see frontend::parameter_members
  std::string source_ir;
  std::vector<lowered_text> processes;
};

/// A program that was built, or why it was not.
struct program {
  std::filesystem::path file;
  std::string problem;  // empty: built
};

/// The kernel in a driver, by a C++ compiler; `options` are further ones.
[[nodiscard]] program build_native(const top_parts& top, const dataflow::network& n,
                                   const std::filesystem::path& folder, const std::string& name,
                                   const std::string& compiler, const std::vector<std::string>& options);
/// What clang made of the source.
[[nodiscard]] program build_source_ir(const top_parts& top, const dataflow::network& n,
                                      const std::filesystem::path& folder);
/// The lowered processes. A run may stop when an output has some tokens more than `wanted` (only if that has no end).
[[nodiscard]] program build_lowered_ir(const top_parts& top, const dataflow::network& n,
                                       const std::filesystem::path& folder, const reference& wanted);

/// Runs a program with the inputs of each port. `problem` gets what went wrong, if anything did.
[[nodiscard]] answer run(const program& what, const dataflow::network& n, const std::vector<token_list>& inputs,
                         std::string& problem);
/// Runs a native program with random inputs, `tokens` of them.
[[nodiscard]] answer run_random(const program& what, const dataflow::network& n, std::uint64_t seed,
                                std::uint64_t tokens, std::string& problem);

}  // namespace epiline::check
