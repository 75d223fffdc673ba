#pragma once
// Choices between a value and 0 that cost nothing.

#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/attempt.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/problem.hpp"
#include "schedule/schedule.hpp"

namespace epiline::schedule {

/// What the node `n` lets through if it is a choice between a value and 0; `none` if it is not.
[[nodiscard]] dataflow::node_id gated_value(const dataflow::graph& g, const dataflow::node& n);

/// A choice between a value and 0 is free where a flip-flop takes it, as the flip-flop's reset, and a row of LUTs in
/// front of an adder, a comparison or a RAM, which have no gates of their own, or in front of two flip-flops. The
/// schedule does not know: for it a value may wait in front of the choice or behind it.
///
/// Adds to the earliest schedule `a` what a choice needs for that: a condition that is there some stages earlier, for
/// flip-flops of its own and their copies. Only where the earliest schedule obeys already, so it costs no stage; what
/// `a.system` was built into stays as it was.
void ask_for_early_conditions(const dataflow::graph& g, const problem& p, attempt& a);

/// Where a value waits in flip-flops for nothing but such choices, moves them to the stage that ends in the last of
/// these flip-flops: none is added, and no chain comes out longer than the period allows. `s`: the schedule as it is;
/// `stage`, per variable of `p`, is what it was made from.
void move_gates_to_flip_flops(const dataflow::graph& g, const delay_model& model, const problem& p, const result& s,
                              std::vector<int>& stage);

}  // namespace epiline::schedule
