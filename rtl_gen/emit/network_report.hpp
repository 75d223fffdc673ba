#pragma once
// The report of a network: the processes' own reports, the FIFOs between them, and the sums.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataflow/network.hpp"
#include "emit/report.hpp"

namespace epiline::emit {

/// By docs/report.schema.json, with the keys "processes" (a report each) and "streams" (the FIFOs) instead of those
/// that speak of one pipeline; of a single process its own report. `passes` are their statistics, one entry a process.
/// The clock is predicted in `delays`, for all processes on one device; without delays it is null.
[[nodiscard]] nlohmann::json make_network_report(const dataflow::network& n, const schedule::delay_model& model,
                                                 const std::vector<schedule::result>& schedules,
                                                 const std::vector<nlohmann::json>& passes, bool axi_lite,
                                                 const std::optional<device_delays>& delays = {});

/// Enters what a simulation saw: by FIFO of the network, the most tokens it held (`peak_fills` is empty where the
/// report has no streams).
void add_peak_fills(nlohmann::json& report, const std::vector<std::uint64_t>& peak_fills);

/// The same for people.
[[nodiscard]] std::string network_report_text(const nlohmann::json& report);

}  // namespace epiline::emit
