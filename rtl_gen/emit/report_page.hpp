#pragma once
// report.html: the report as a page to look at, with the source beside the schedule. One file that needs no other.

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace epiline::emit {

/// `report` must come from make_report() or make_network_report(). `sources`: the text of each file that the report
/// names, by that name; a file that is missing is told by its line numbers only. The page is the same for the same
/// input, byte for byte.
[[nodiscard]] std::string report_page(const nlohmann::json& report, const std::map<std::string, std::string>& sources);

}  // namespace epiline::emit
