#pragma once
// The passes in the order the compiler runs them.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// The size of a graph, as reports show it.
struct graph_size {
  std::uint64_t nodes = 0;  // that compute something: no constants, slices, concatenations or extensions
  std::uint64_t register_bits = 0;
  std::uint64_t memory_bits = 0;
  bool operator==(const graph_size&) const = default;
};
[[nodiscard]] graph_size size_of(const dataflow::graph& g);

struct pass_report {
  std::string pass;
  graph_size before, after;
};

struct pipeline_options {
  unsigned forwarded_writes = 1;   // see forward_memories
  unsigned multiplier_width = 18;  // see expand_arithmetic
  /// If given, called after each pass with the pass's name and the graphs before and after it, in which registers,
  /// memories and tables have their `origin`.
  std::function<void(std::string_view pass, const dataflow::graph& before, const dataflow::graph& after)> observer = {};
};

/// Gives every register, memory and table its own number as `origin`, so that what a pass makes of it can be told.
void number_objects(dataflow::graph& g);

/// Runs all passes and tells what each one changed. The result outputs what `g` did (unspecified values count as 0, as
/// in the interpreter) and has every memory's reads before its write. Throws memory_error (forward_memories.hpp) for
/// memories that cannot be built, std::logic_error when `g` or what a pass made of it breaks a rule of graph.hpp.
std::vector<pass_report> run_default_pipeline(dataflow::graph& g, const pipeline_options& options = {});

/// A list of {"pass", "before", "after"}, the sizes as {"nodes", "register_bits", "memory_bits"}.
[[nodiscard]] nlohmann::json to_json(const std::vector<pass_report>& reports);

}  // namespace epiline::passes
