#pragma once
// Verilog-2005 of a network: a top module that joins the processes' modules by FIFOs, those modules, and the FIFO's.

#include <string>
#include <vector>

#include "dataflow/network.hpp"
#include "emit/verilog.hpp"

namespace epiline::emit {

/// The top of a network as a graph without operations: name, files and ports, for what looks at these only.
[[nodiscard]] dataflow::graph outside_of(const dataflow::network& n);

/// The name of the FIFO's instance in the top module.
[[nodiscard]] std::string fifo_instance_name(const dataflow::fifo& f);

/// The file, the same for the same input. `schedules` are those of the processes. Throws std::invalid_argument like
/// emit_verilog.
[[nodiscard]] verilog_text emit_network(const dataflow::network& n, const schedule::delay_model& model,
                                        const std::vector<schedule::result>& schedules,
                                        const verilog_options& options = {});

}  // namespace epiline::emit
