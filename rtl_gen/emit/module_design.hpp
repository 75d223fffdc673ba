#pragma once
// What the text of a module is written from; it does not change while it is written.

#include <vector>

#include "dataflow/graph.hpp"
#include "emit/interface.hpp"
#include "emit/plan.hpp"
#include "emit/verilog.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

struct module_design {
  module_design(const dataflow::graph& graph, const schedule::delay_model& delays, const schedule::result& schedule,
                const verilog_options& wanted);

  const dataflow::graph& g;
  const schedule::delay_model& model;
  const schedule::result& s;
  const verilog_options& options;
  const emit::plan plan;
  const std::vector<rtl_port> interface;
  /// Per stage: the nodes that work in it, the registers that are read in it, and those that are updated at its end.
  std::vector<std::vector<dataflow::node_id>> nodes_at;
  std::vector<std::vector<dataflow::register_id>> registers_at, updates_at;

  /// Whether a port's tokens are arguments, sampled from registers behind an AXI4-Lite slave.
  [[nodiscard]] bool is_sampled(const dataflow::port& port) const {
    return options.axi_lite && port.kind == dataflow::port_kind::call;
  }
  /// Whether a condition is the constant 1.
  [[nodiscard]] bool is_always(dataflow::node_id id) const {
    return g.nodes[id].kind == dataflow::operation::constant && g.nodes[id].value.isAllOnes();
  }
};

}  // namespace epiline::emit
