#pragma once
// Parts of the report that lead costs back to the source: lines, variables, and what limits the speed.

#include <nlohmann/json.hpp>
#include <string>

#include "dataflow/graph.hpp"
#include "emit/plan.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

/// {"file", "line"}, or null when unknown.
[[nodiscard]] nlohmann::json location(const dataflow::graph& g, dataflow::source_location where);
/// "file.cpp:12" of a location().
[[nodiscard]] std::string location_text(const nlohmann::json& where);

/// The source's name of a value: its own, or that of the register, memory, table or port it comes from.
[[nodiscard]] std::string value_name(const dataflow::graph& g, const dataflow::node& n);

/// Every source line that has operations: what it costs and the stages it works in, by file and line.
[[nodiscard]] nlohmann::json describe_lines(const dataflow::graph& g, const schedule::delay_model& model,
                                            const schedule::result& s, const plan& p);

/// The bits that each variable of the source takes, the largest first. The elements of an array are one variable.
[[nodiscard]] nlohmann::json describe_variables(const dataflow::graph& g, const schedule::result& s, const plan& p);

/// What keeps the design from being faster, and what to do about it. `report` has its clock, interval, critical chain
/// and recurrence already.
[[nodiscard]] nlohmann::json describe_limit(const nlohmann::json& report);

}  // namespace epiline::emit
