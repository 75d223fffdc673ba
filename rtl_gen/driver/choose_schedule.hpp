#pragma once
// The schedule of a process as the command line asks for it: which clock, how many clocks an iteration.

#include "dataflow/graph.hpp"
#include "driver/command_line.hpp"
#include "schedule/schedule.hpp"

namespace epiline::driver {

/// Schedules `graph` at the smallest initiation interval that is allowed and possible, by `allowed_by_source` (PIPELINE
/// II) or --ii. Without --clock a period that cannot be reached becomes the smallest possible, with a note on standard
/// error. The graph foresees its reads (passes/foresee_reads.hpp) afterwards if that costs neither period nor clocks.
/// Throws schedule::infeasible.
[[nodiscard]] schedule::result choose_schedule(dataflow::graph& graph, const schedule::delay_model& model,
                                               const command_line& given, unsigned allowed_by_source);

}  // namespace epiline::driver
