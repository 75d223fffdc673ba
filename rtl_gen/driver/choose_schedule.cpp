#include "driver/choose_schedule.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <utility>

#include "passes/foresee_reads.hpp"

namespace epiline::driver {

namespace {

/// The schedule that --schedule asks for.
schedule::result schedule_as_asked(const dataflow::graph& graph, const schedule::delay_model& model,
                                   const schedule::options& options, const command_line& given) {
  return given.scheduler == "random" ? schedule::make_random_schedule(graph, model, options, given.seed)
                                     : schedule::make_schedule(graph, model, options);
}

/// The schedule, at the smallest initiation interval allowed that is possible.
schedule::result find_schedule(const dataflow::graph& graph, const schedule::delay_model& model,
                               const command_line& given, unsigned allowed_by_source) {
  schedule::options options;
  options.period = given.period;
  int largest = static_cast<int>(allowed_by_source);
  if (given.interval == "auto")
    largest = 64;
  else if (given.interval != "1")
    options.initiation_interval = largest = std::atoi(given.interval.c_str());
  for (;; ++options.initiation_interval) {
    try {
      return schedule_as_asked(graph, model, options, given);
    } catch (const schedule::infeasible& refusal) {
      if (options.initiation_interval < largest) continue;
      // What goes through a memory's address and back takes clocks, however long they are.
      if (!given.interval_is_given && refusal.smallest_period() <= 0 && refusal.smallest_interval() > 0) {
        std::cerr << fmt::format(
            "note: {} cannot be reached with any period; made for one every {} clocks. The reason:\n{}\n",
            options.initiation_interval == 1
                ? "one iteration every clock"
                : fmt::format("one iteration every {} clocks", options.initiation_interval),
            refusal.smallest_interval(), refusal.what());
        largest = refusal.smallest_interval();
        options.initiation_interval = largest - 1;
        continue;
      }
      if (given.period_is_given || options.period != given.period || refusal.smallest_period() <= 0) throw;
      std::cerr << fmt::format(
          "note: {:.2f} ns cannot be reached; made for {:.2f} ns, the smallest period possible. The reason:\n{}\n",
          given.period, refusal.smallest_period(), refusal.what());
      options.period = refusal.smallest_period();
      --options.initiation_interval;
    }
  }
}

}  // namespace

schedule::result choose_schedule(dataflow::graph& graph, const schedule::delay_model& model, const command_line& given,
                                 unsigned allowed_by_source) {
  schedule::result plain = find_schedule(graph, model, given, allowed_by_source);
  dataflow::graph foreseen = graph;
  if (!passes::foresee_reads(foreseen)) return plain;
  try {
    schedule::result found = schedule_as_asked(foreseen, model, {plain.period, plain.initiation_interval}, given);
    graph = std::move(foreseen);
    return found;
  } catch (const schedule::infeasible&) {
    return plain;
  }
}

}  // namespace epiline::driver
