#pragma once
// How long the chains of a finished schedule take, stage by stage.

#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/schedule.hpp"

namespace epiline::schedule {

/// Nanoseconds by which sums of delays may differ because they are added in another order.
inline constexpr double tolerance = 1e-6;

/// Arrival times in every stage: what validate() checks and where the critical chain comes from.
struct timing {
  std::vector<double> arrival;              // per node, nanoseconds from the clock to its result
  std::vector<dataflow::node_id> previous;  // per node, the operand that arrives last in the same stage
  double worst = 0;
  dataflow::node_id worst_end = dataflow::none;  // the last node of the slowest chain
  double worst_entry = 0;                        // what its end adds after that node
};
[[nodiscard]] timing analyse(const dataflow::graph& g, const delay_model& model, const result& s);

/// Sets the critical chain of `s` and its delay.
void find_critical_chain(const dataflow::graph& g, const delay_model& model, result& s);

}  // namespace epiline::schedule
