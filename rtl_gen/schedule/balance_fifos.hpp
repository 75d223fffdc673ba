#pragma once

#include <vector>

#include "dataflow/network.hpp"
#include "schedule/schedule.hpp"

namespace epiline::schedule {

/// Clocks from a token's entry into a FIFO between processes to its appearance at the output.
inline constexpr int fifo_latency = 2;

/// Clocks from the acceptance of a process's input to the appearance of its output `port`.
[[nodiscard]] int latency_of(const dataflow::graph& g, const result& s, dataflow::port_id port);

/// Makes FIFOs so deep that two ways of different length from one process to another do not slow each other down: the
/// shorter one holds what comes, a token a clock, while the longer one is under way. Only FIFOs with `may_grow` are
/// changed, none gets shallower. `schedules` and `may_grow` are those of n.processes and n.fifos.
void balance_fifos(dataflow::network& n, const std::vector<result>& schedules, const std::vector<bool>& may_grow);

}  // namespace epiline::schedule
