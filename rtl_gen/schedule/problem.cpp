#include "schedule/problem.hpp"

#include <algorithm>

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

namespace {

std::vector<char> find_settled(const graph& g) {
  std::vector<char> is_settled(g.nodes.size(), 0);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    switch (n.kind) {
      case operation::constant:
        is_settled[id] = 1;
        break;
      case operation::register_value:
        is_settled[id] = is_patient(g, n.object);
        break;
      case operation::read:
      case operation::write:
      case operation::memory_read:
      case operation::memory_write:
      case operation::table:
        break;
      default:
        is_settled[id] = std::all_of(n.operands.begin(), n.operands.end(),
                                     [&](node_id operand) { return is_settled[operand] != 0; });
    }
  }
  return is_settled;
}

void at_least(std::vector<constraint>& constraints, variable from, variable to, int distance, reason why) {
  constraints.push_back({from, to, distance, why});
}

void equal(std::vector<constraint>& constraints, variable a, variable b, reason why) {
  at_least(constraints, a, b, 0, why);
  at_least(constraints, b, a, 0, why);
}

}  // namespace

bool is_patient(const graph& g, register_id r) { return g.patient != none && g.registers[r].patient; }

problem::problem(const graph& g, const delay_model& model) : g_(g), settled_(find_settled(g)) {
  const auto nodes = static_cast<variable>(g.nodes.size());
  const auto registers = static_cast<variable>(g.registers.size());
  first_register_ = 1 + nodes;
  first_update_ = first_register_ + registers;
  end_ = first_update_ + registers;
  count_ = end_ + 1;
  for (node_id id = 0; id < nodes; ++id) latency_.push_back(model.latency(g, id));
  collect_accesses();
  find_issue_cone();
}

void problem::collect_accesses() {
  accesses_.resize(g_.memories.size());
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const node& n = g_.nodes[id];
    if (n.kind == operation::memory_read) accesses_[n.object].reads.push_back(id);
    if (n.kind == operation::memory_write) accesses_[n.object].writes.push_back(id);
  }
}

// Whatever a read's predicate depends on, through registers and memories.
void problem::find_issue_cone() {
  in_issue_cone_.assign(g_.nodes.size(), 0);
  register_in_cone_.assign(g_.registers.size(), 0);
  std::vector<char> memory_seen(g_.memories.size(), 0);
  std::vector<node_id> work;
  const auto visit = [&](node_id id) {
    if (settled_[id] || in_issue_cone_[id]) return;
    in_issue_cone_[id] = 1;
    work.push_back(id);
  };
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (g_.nodes[id].kind == operation::read) visit(id);
  }
  if (g_.patient != none) visit(g_.patient);
  while (!work.empty()) {
    const node& n = g_.nodes[work.back()];
    work.pop_back();
    for (const node_id operand : n.operands) visit(operand);
    if (n.kind == operation::register_value && !register_in_cone_[n.object]) {
      register_in_cone_[n.object] = 1;
      visit(g_.registers[n.object].next);
      visit(g_.registers[n.object].enable);
    }
    if (n.kind == operation::memory_read && !memory_seen[n.object]) {
      memory_seen[n.object] = 1;
      for (const node_id write : accesses_[n.object].writes) visit(write);
    }
  }
}

bool problem::decides_issue(variable v) const {
  if (const node_id target = node_of(v); target != none) return in_issue_cone_[target] != 0;
  const register_id r = register_of_update(v);
  return r != none && register_in_cone_[r] != 0;
}

void problem::add_order(int interval, bool apart, std::vector<constraint>& constraints) const {
  add_nodes(constraints);
  add_registers(interval, constraints);
  add_memories(interval, apart, constraints);
}

/// Every node after its operands, what decides the issue in stage 0.
void problem::add_nodes(std::vector<constraint>& constraints) const {
  std::vector<node_id> port_write(g_.ports.size(), none);
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (settled_[id]) continue;
    const node& n = g_.nodes[id];
    const variable v = of_node(id);
    // Only what decides the issue works in stage 0, whose valid bit comes late.
    const bool late = !in_issue_cone_[id] && (n.kind == operation::write || n.kind == operation::memory_write);
    at_least(constraints, 0, v, late ? 1 : 0, reason::order);
    for (const node_id operand : n.operands) {
      if (!settled_[operand]) at_least(constraints, of_node(operand), v, latency_[operand], reason::data);
    }
    if (n.kind == operation::read) at_least(constraints, v, 0, 0, reason::issue);
    if (n.kind == operation::register_value) {
      equal(constraints, of_register(n.object), v, reason::data);
    }
    if (n.kind == operation::write) {
      node_id& first = port_write[n.object];
      if (first == none) {
        first = id;
      } else {
        equal(constraints, of_node(first), v, reason::order);
      }
    }
    at_least(constraints, v, end_, latency_[id], reason::order);
  }
  if (g_.patient != none && !settled_[g_.patient]) at_least(constraints, of_node(g_.patient), 0, 0, reason::issue);
}

/// Updates after what they take over, early enough for the next iteration.
void problem::add_registers(int interval, std::vector<constraint>& constraints) const {
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    const dataflow::register_state& state = g_.registers[r];
    const bool patient = is_patient(g_, r);
    const variable update = of_update(r);
    for (const node_id source : {state.next, state.enable}) {
      if (!settled_[source]) at_least(constraints, of_node(source), update, latency_[source], reason::data);
    }
    at_least(constraints, 0, update, register_in_cone_[r] ? 0 : 1, reason::order);
    at_least(constraints, update, end_, 0, reason::order);
    if (patient) continue;
    at_least(constraints, 0, of_register(r), register_in_cone_[r] ? 0 : 1, reason::order);
    at_least(constraints, of_register(r), update, 0, reason::order);
    at_least(constraints, update, of_register(r), -(interval - 1), reason::recurrence);
  }
}

/// Clocks from the beginning of an iteration to each node at least, by the latencies on its way.
std::vector<int> problem::earliest() const {
  std::vector<int> clocks(g_.nodes.size(), 0);
  for (node_id id = 0; id < g_.nodes.size(); ++id)
    for (const node_id operand : g_.nodes[id].operands)
      if (!settled_[operand]) clocks[id] = std::max(clocks[id], clocks[operand] + latency_[operand]);
  return clocks;
}

/// Writes after the reads of the same iteration and before those that come to the word again.
void problem::add_memories(int interval, bool apart, std::vector<constraint>& constraints) const {
  const std::vector<int> clocks = earliest();
  for (std::size_t m = 0; m < accesses_.size(); ++m) {
    const memory_accesses& a = accesses_[m];
    const int window = static_cast<int>(std::min(g_.memories[m].distance, 1u << 20)) * interval - 1;
    for (const node_id write : a.writes) {
      for (const node_id read : a.reads) {
        at_least(constraints, of_node(read), of_node(write), apart && window > 0 ? 1 : 0, reason::memory);
        at_least(constraints, of_node(write), of_node(read), -window, reason::memory);
      }
      if (write != a.writes[0]) equal(constraints, of_node(a.writes[0]), of_node(write), reason::memory);
    }
    // Reads of one address share one port of the RAM, unless one of them may hang on what another one reads.
    for (std::size_t i = 1; i < a.reads.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (g_.nodes[a.reads[i]].operands[0] != g_.nodes[a.reads[j]].operands[0]) continue;
        if (clocks[a.reads[i]] != clocks[a.reads[j]]) continue;
        equal(constraints, of_node(a.reads[j]), of_node(a.reads[i]), reason::memory);
        break;
      }
    }
  }
}

}  // namespace epiline::schedule
