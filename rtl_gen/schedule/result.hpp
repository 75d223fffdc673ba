#pragma once
// From the stages of all variables to a schedule.

#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/problem.hpp"
#include "schedule/schedule.hpp"

namespace epiline::schedule {

/// The schedule for what is `wanted` that `stage` (per variable of `p`) says, with its critical chain.
[[nodiscard]] result make_result(const dataflow::graph& g, const delay_model& model, const options& wanted,
                                 const problem& p, const std::vector<int>& stage);

}  // namespace epiline::schedule
