#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Makes one wide memory of memories that are always accessed together: same number of words, distance and promise,
/// same address and enable nodes of their reads and writes (so run it on a graph with shared expressions), initial
/// contents all given or all unspecified, data that comes at about the same time (an early word would have to wait in
/// registers for a late one), words of up to 288 bits together. The first one lies in the low bits and gives the name,
/// with the count behind it ("rows_x3"). Needs the order order_memory_accesses makes.
void pack_memories(dataflow::graph& g);

}  // namespace epiline::passes
