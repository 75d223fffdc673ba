#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Makes one register of registers that always hold the same value, such as the column counters of several kernels:
/// same initial value, and next values and enables that are equal if the registers are. (An unspecified initial value
/// counts as 0, as in the interpreter.) Leaves the unused ones to remove_dead.
void merge_registers(dataflow::graph& g);

}  // namespace epiline::passes
