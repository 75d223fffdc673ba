#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// A value negated under a condition, (x ^ s...s) + s, is an operation of its own only for its carry. Where such a
/// value is added or subtracted, a + |d| or a - |d|, one add_or_subtract does both: a sum of absolute differences then
/// takes one carry chain a difference and one an addition. What is left becomes an add_or_subtract with 0.
///
/// For hardware only, so it stands at the end: no other pass knows the sums it makes.
void fold_magnitudes(dataflow::graph& g);

}  // namespace epiline::passes
