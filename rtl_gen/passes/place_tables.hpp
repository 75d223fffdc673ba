#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Marks the tables whose word is needed in the clock of its address: those read in a recurrence, and those that decide
/// whether a token is taken. They become logic, since a block RAM answers clocks later.
void place_tables(dataflow::graph& g);

}  // namespace epiline::passes
