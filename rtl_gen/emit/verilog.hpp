#pragma once
// Verilog-2005 of a scheduled graph: one self-contained module that Yosys, Verilator and Icarus take without warnings.

#include <string>

#include "dataflow/graph.hpp"
#include "emit/plan.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

struct verilog_options {
  delay_line_limits delay_lines = {};
  bool axi_lite = false;     // the scalars are registers behind an AXI4-Lite slave, a second module of the file
  std::string heading = {};  // what the file's first comment says below its title, line by line; may be empty
};

/// The module's text, the same for the same input. `s` must satisfy schedule::validate().
/// Throws std::invalid_argument when a port or scalar cannot have its name in Verilog (a keyword, not an identifier, or
/// taken by another signal), and when axi_lite is wanted for a top without scalars.
[[nodiscard]] std::string emit_verilog(const dataflow::graph& g, const schedule::delay_model& model,
                                       const schedule::result& s, const verilog_options& options = {});

}  // namespace epiline::emit
