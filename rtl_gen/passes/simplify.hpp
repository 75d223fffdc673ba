#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Applies the rules of rules.hpp to every node, shares equal expressions, replaces registers that always hold their
/// initial value by it (an unspecified one counts as 0, as in the interpreter), drops accesses that never take place
/// and removes what nothing uses (remove_dead.hpp). Needs and keeps every rule of graph.hpp.
void simplify(dataflow::graph& g);

}  // namespace epiline::passes
