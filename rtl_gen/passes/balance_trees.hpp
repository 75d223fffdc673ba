#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Turns chains of one associative operation (sums, and, or, xor, minimum, maximum) whose intermediate results have no
/// other use into balanced trees, so their depth grows with the logarithm of their length. Sums are added at the widths
/// their results need once narrow_widths ran again. Leaves what it replaced to remove_dead.
void balance_trees(dataflow::graph& g);

}  // namespace epiline::passes
