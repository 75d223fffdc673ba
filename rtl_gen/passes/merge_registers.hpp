#pragma once

#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// For every register the first one that always holds the same value, itself if there is no earlier one.
[[nodiscard]] std::vector<dataflow::register_id> first_equal_registers(const dataflow::graph& g);

/// Makes one register of registers that always hold the same value, such as the column counters of several kernels:
/// same initial value, and next values and enables that are equal if the registers are. (An unspecified initial value
/// counts as 0, as in the interpreter.) Leaves the unused ones to remove_dead.
void merge_registers(dataflow::graph& g);

}  // namespace epiline::passes
