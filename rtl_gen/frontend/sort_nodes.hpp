#pragma once

#include "dataflow/graph.hpp"

namespace epiline::frontend {

/// Operands before users, reads of a memory before its write, unused nodes away.
void sort_nodes(dataflow::graph& graph);

}  // namespace epiline::frontend
