#include "emit/module_design.hpp"

namespace epiline::emit {

using dataflow::node_id;
using dataflow::register_id;
using schedule::settled;

module_design::module_design(const dataflow::graph& graph, const schedule::delay_model& delays,
                             const schedule::result& schedule, const verilog_options& wanted)
    : g(graph),
      model(delays),
      s(schedule),
      options(wanted),
      plan(make_plan(graph, delays, schedule, wanted.delay_lines)),
      interface(interface_of(graph, wanted.axi_lite)),
      nodes_at(schedule.depth),
      registers_at(schedule.depth),
      updates_at(schedule.depth) {
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (s.stage[id] != settled) nodes_at[s.stage[id]].push_back(id);
  }
  for (register_id r = 0; r < g.registers.size(); ++r) {
    if (s.register_stage[r] != settled) registers_at[s.register_stage[r]].push_back(r);
    updates_at[s.register_update[r]].push_back(r);
  }
}

}  // namespace epiline::emit
