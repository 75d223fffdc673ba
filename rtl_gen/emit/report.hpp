#pragma once
// What was built and why it is as large and as slow as it is: report.json (a stable schema) and report.txt, made from
// it.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "dataflow/graph.hpp"
#include "emit/clock_prediction.hpp"
#include "emit/plan.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

struct report_options {
  delay_line_limits delay_lines = {};               // the same as for the Verilog
  bool axi_lite = false;                            // likewise
  nlohmann::json passes = nlohmann::json::array();  // statistics of the passes, as the caller has them
  std::optional<device_delays> delays = {};         // for the prediction of the clock; none: it is null
};

/// Schema "epiline-report/4", docs/report.schema.json. Key "interface" suffices to drive the module.
[[nodiscard]] nlohmann::json make_report(const dataflow::graph& g, const schedule::delay_model& model,
                                         const schedule::result& s, const report_options& options = {});

/// Key "interface" of the report: the ports of the module.
[[nodiscard]] nlohmann::json describe_interface(const dataflow::graph& g, bool axi_lite);

/// The same for people. `report` must come from make_report().
[[nodiscard]] std::string report_text(const nlohmann::json& report);

}  // namespace epiline::emit
