#pragma once
// The passes in the order the compiler runs them.

#include <cstdint>
#include <string>
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

struct pass_record {
  std::string pass;
  graph_size before, after;
};

struct pipeline_options {
  unsigned forwarded_writes = 1;  // see forward_memories
};

/// Runs all passes. The result outputs what `g` did (unspecified values count as 0, as in the interpreter) and has
/// every memory's reads before its write. Records each pass in `log` if that is given. Throws memory_error
/// (forward_memories.hpp) for memories that cannot be built, std::logic_error when `g` or a pass breaks a rule of
/// graph.hpp.
void run_default_pipeline(dataflow::graph& g, std::vector<pass_record>* log = nullptr,
                          const pipeline_options& options = {});

}  // namespace epiline::passes
