#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Turns chains of one associative operation (sums, and, or, xor, minimum, maximum) whose intermediate results have no
/// other use into balanced trees, so their depth grows with the logarithm of their length. Sums are added at the widths
/// of their operands: a tree of n-bit terms has n + 1 bits after its first level, and so on.
void balance_trees(dataflow::graph& g);

}  // namespace epiline::passes
