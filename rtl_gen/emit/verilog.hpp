#pragma once
// Verilog-2005 of a scheduled graph: one self-contained module that Yosys, Verilator and Icarus take without warnings.

#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/plan.hpp"
#include "emit/signals.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

struct verilog_options {
  delay_line_limits delay_lines = {};
  bool axi_lite = false;     // the scalars are registers behind an AXI4-Lite slave, a second module of the file
  std::string heading = {};  // what the file's first comment says below its title, line by line; may be empty
};

/// The text of a file, and what the names in it come from.
struct verilog_text {
  std::string text;
  std::vector<module_signals> modules;
};

/// The module, the same for the same input. `s` must satisfy schedule::validate().
/// Throws std::invalid_argument when a port or scalar cannot have its name in Verilog (a keyword, not an identifier, or
/// taken by another signal), and when axi_lite is wanted for a top without scalars.
[[nodiscard]] verilog_text emit_module(const dataflow::graph& g, const schedule::delay_model& model,
                                       const schedule::result& s, const verilog_options& options = {});
/// Its text only.
[[nodiscard]] std::string emit_verilog(const dataflow::graph& g, const schedule::delay_model& model,
                                       const schedule::result& s, const verilog_options& options = {});

}  // namespace epiline::emit
