#include "schedule/timing.hpp"

#include <algorithm>

#include "schedule/problem.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

timing analyse(const graph& g, const delay_model& model, const result& s) {
  timing t;
  const delay_parameters& p = model.parameters();
  t.arrival.assign(g.nodes.size(), p.launch);
  t.previous.assign(g.nodes.size(), none);
  const auto finish = [&](node_id at, int stage, double entry) {
    const bool chained = s.stage[at] != settled && s.stage[at] == stage && s.available[at] == stage;
    const double total = (chained ? t.arrival[at] : p.launch) + entry + p.capture;
    if (total > t.worst) {
      t.worst = total;
      t.worst_end = at;
      t.worst_entry = entry;
    }
  };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    double in = p.launch;
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      const bool chained =
          s.stage[id] != settled && s.available[operand] == s.stage[id] && s.stage[operand] == s.stage[id];
      const bool wired = s.stage[id] == settled && s.stage[operand] == settled && !is_settled_register(g, s, operand);
      const double at = (chained || wired ? t.arrival[operand] : p.launch) + model.entry(g, id, i);
      if (at > in || (at >= in && t.previous[id] == none && chained)) {
        in = at;
        t.previous[id] = chained ? operand : none;
      }
    }
    t.arrival[id] = in + model.delay(g, id);
    const double total = t.arrival[id] + p.capture;
    if (n.kind != operation::constant && total > t.worst) {
      t.worst = total;
      t.worst_end = id;
      t.worst_entry = 0;
    }
    if (n.kind == operation::read) finish(n.operands[0], 0, p.issue);
  }
  for (register_id r = 0; r < g.registers.size(); ++r) {
    finish(g.registers[r].next, s.register_update[r], 0);
    finish(g.registers[r].enable, s.register_update[r], model.enable_entry());
  }
  if (g.patient != none) finish(g.patient, 0, model.enable_entry());
  return t;
}

void find_critical_chain(const graph& g, const delay_model& model, result& s) {
  const timing t = analyse(g, model, s);
  s.critical_delay = t.worst;
  s.critical_chain.clear();
  for (node_id id = t.worst_end; id != none; id = t.previous[id]) {
    const double before = t.previous[id] == none ? model.parameters().launch : t.arrival[t.previous[id]];
    s.critical_chain.push_back({id, t.arrival[id] - before});
  }
  if (!s.critical_chain.empty()) s.critical_chain.front().delay += t.worst_entry;
  std::reverse(s.critical_chain.begin(), s.critical_chain.end());
}

std::vector<recurrence_delay> recurrences(const graph& g, const delay_model& model, const result& s) {
  // Registers whose value reaches each other lie in one component; chains inside the component are its loop.
  const problem p(g, model);
  constraint_system system;
  p.add_order(s.initiation_interval, false, system.constraints);
  system.build(p.count());
  std::vector<double> at(g.nodes.size(), -1);  // arrival along the component only
  const auto component = [&](node_id id) { return system.component[p.of_node(id)]; };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (s.stage[id] == settled) continue;
    const node& n = g.nodes[id];
    if (n.kind == operation::register_value) {
      at[id] = model.parameters().launch;
      continue;
    }
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      if (s.stage[operand] == settled || at[operand] < 0 || component(operand) != component(id)) continue;
      at[id] = std::max(at[id], at[operand] + model.entry(g, id, i) + model.delay(g, id));
    }
  }
  std::vector<recurrence_delay> all;
  for (register_id r = 0; r < g.registers.size(); ++r) {
    if (s.register_stage[r] == settled) continue;
    double delay = -1;
    const auto end = [&](node_id id, double entry) {
      if (s.stage[id] == settled || at[id] < 0 || g.nodes[id].kind == operation::register_value) return;
      if (component(id) == system.component[p.of_register(r)]) delay = std::max(delay, at[id] + entry);
    };
    end(g.registers[r].next, 0);
    end(g.registers[r].enable, model.enable_entry());
    if (delay >= 0) all.push_back({r, delay + model.parameters().capture});
  }
  return all;
}

}  // namespace epiline::schedule
