#pragma once
// Breaks a graph on purpose, for the tests of the proofs: what a mistake in a pass would leave behind.

#include <optional>
#include <string>

#include "dataflow/graph.hpp"

namespace epiline::prove {

/// Replaces what node `id` computes by something similar of the same width, such as a sum by a difference; the graph
/// keeps the rules of graph.hpp. Returns what was done ("add became subtract"), or nothing for a node that is left
/// alone. What the graph outputs may stay the same all the same.
std::optional<std::string> plant_fault(dataflow::graph& g, dataflow::node_id id);

/// A graph with a fault at the last node that can have one.
[[nodiscard]] dataflow::graph with_fault(dataflow::graph g);

}  // namespace epiline::prove
