#include "schedule/result.hpp"

#include <algorithm>

#include "schedule/timing.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

namespace {

/// Fills `s` from the stages of all variables.
void fill(const graph& g, const delay_model& model, const problem& p, const std::vector<int>& stage, result& s) {
  const std::size_t count = g.nodes.size();
  s.stage.assign(count, settled);
  s.available.assign(count, settled);
  s.settle_level.assign(count, 0);
  s.register_stage.assign(g.registers.size(), settled);
  s.register_update.assign(g.registers.size(), 0);
  int last = 0;
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (p.is_settled()[id]) {
      for (const node_id operand : n.operands) {
        s.settle_level[id] = std::max(s.settle_level[id], s.settle_level[operand]);
      }
      if (is_settled_register(g, s, id)) ++s.settle_level[id];
      continue;
    }
    s.stage[id] = stage[p.of_node(id)];
    s.available[id] = s.stage[id] + model.latency(g, id);
    last = std::max(last, s.available[id]);
  }
  bool any_patient = false;
  int settle = 0;
  for (register_id r = 0; r < g.registers.size(); ++r) {
    s.register_update[r] = stage[p.of_update(r)];
    last = std::max(last, s.register_update[r]);
    if (is_patient(g, r)) {
      any_patient = true;
      s.commit = std::max(s.commit, s.register_update[r] + 1);
    } else {
      s.register_stage[r] = stage[p.of_register(r)];
    }
  }
  s.hold = 0;
  if (any_patient) {
    // Iterations in flight go on using the old values: nothing may change before the last of them has.
    const auto note = [&](node_id value, int at) {
      const bool changes = s.stage[value] == settled && g.nodes[value].kind != operation::constant;
      if (changes) s.commit = std::max(s.commit, at);
    };
    for (node_id id = 0; id < count; ++id) {
      if (s.stage[id] == settled) {
        settle = std::max(settle, s.settle_level[id]);
      } else {
        for (const node_id operand : g.nodes[id].operands) note(operand, s.stage[id]);
      }
    }
    for (register_id r = 0; r < g.registers.size(); ++r) {
      note(g.registers[r].next, s.register_update[r]);
      note(g.registers[r].enable, s.register_update[r]);
    }
    last = std::max(last, s.commit);
    s.hold = s.commit + settle;
  } else {
    s.commit = 0;
  }
  s.depth = last + 1;

  std::vector<int> wait(count, 0);
  for (const use& u : uses(g, s)) wait[u.value] = std::max(wait[u.value], u.stage - s.available[u.value]);
  s.pipeline_bits = 0;
  for (node_id id = 0; id < count; ++id) s.pipeline_bits += static_cast<std::uint64_t>(wait[id]) * g.nodes[id].width;
}

}  // namespace

bool is_settled_register(const graph& g, const result& s, node_id id) {
  return s.stage[id] == settled && !is_wire(g, id);
}

std::vector<use> uses(const graph& g, const result& s) {
  std::vector<use> all;
  const auto note = [&](node_id value, int stage, bool enables = false) {
    if (s.stage[value] != settled) all.push_back({value, stage, enables});
  };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (s.stage[id] == settled) continue;
    const node& n = g.nodes[id];
    for (std::size_t i = 0; i < n.operands.size(); ++i)
      note(n.operands[i], s.stage[id], dataflow::is_write_enable(n, i));
  }
  for (register_id r = 0; r < g.registers.size(); ++r) {
    note(g.registers[r].next, s.register_update[r]);
    note(g.registers[r].enable, s.register_update[r], true);
  }
  return all;
}

result make_result(const graph& g, const delay_model& model, const options& wanted, const problem& p,
                   const std::vector<int>& stage) {
  result s;
  s.period = wanted.period;
  s.initiation_interval = wanted.initiation_interval;
  fill(g, model, p, stage, s);
  find_critical_chain(g, model, s);
  return s;
}

}  // namespace epiline::schedule
