#pragma once

#include <string>

#include "frontend/lower.hpp"

namespace epiline::frontend {

/// Turns the lowered process into the dataflow graph of one step: control flow becomes predicates and selects, values
/// that live from step to step become registers. `name` becomes the graph's. Refuses what has no hardware form yet.
[[nodiscard]] dataflow::graph build_graph(lowered_process& process, const std::string& name);

}  // namespace epiline::frontend
