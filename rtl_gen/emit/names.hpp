#pragma once
// Which names may stand in Verilog.

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/interface.hpp"

namespace epiline::emit {

[[nodiscard]] bool is_keyword(std::string_view name);
[[nodiscard]] bool is_identifier(std::string_view name);

/// Adds the names of the module and of its ports to `taken`. Returns the stems of ports that look like a pipeline's
/// copies ("x" of "x_s3"). Throws std::invalid_argument for a name that cannot be had in Verilog, or twice.
std::vector<std::string> reserve_signals(const dataflow::graph& g, const std::vector<rtl_port>& interface,
                                         std::unordered_set<std::string>& taken);

}  // namespace epiline::emit
