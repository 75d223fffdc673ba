#pragma once
// Why there is no schedule, for a person.

#include <string>

#include "dataflow/graph.hpp"
#include "schedule/attempt.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/schedule.hpp"

namespace epiline::schedule {

/// Throws the explanation of `failed`, an attempt at what is `wanted` without a schedule: what limits and where it
/// stands in the source, the operations of the chain, and the smallest period and interval that can be had.
[[noreturn]] void explain(const dataflow::graph& g, const delay_model& model, const attempts& all,
                          const options& wanted, const attempt& failed);

}  // namespace epiline::schedule
