#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Gives every value, register, memory and table the fewest bits that preserve what the graph outputs: bits nothing
/// depends on go, and so do high bits that are known to be zero or copies of the sign (known_values.hpp,
/// demanded_bits.hpp). Values that are known entirely become constants. Leaves what became unused to remove_dead.
void narrow_widths(dataflow::graph& g);

}  // namespace epiline::passes
