#include "schedule/fan_out.hpp"

#include <algorithm>
#include <cmath>

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::operation;
using dataflow::register_id;

namespace {

/// Inputs that one bit of operand `index` drives in node `n`, which is not a wire.
double inputs_of(const graph& g, const delay_model& model, const node& n, std::size_t index) {
  switch (n.kind) {
    case operation::select:
      return index == 0 ? n.width : 1;
    case operation::add_or_subtract:
      return index == 2 ? n.width : 1;
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return index == 1 ? n.width : std::log2(n.width + 1.0);
    case operation::multiply: {
      const unsigned other = g.nodes[n.operands[1 - index]].width;
      return model.parameters().multiplier_width == 0 ? other : 1;
    }
    case operation::read:
      return n.width;
    case operation::write:
      return index == 0 ? g.ports[n.object].width : 1;
    case operation::table:
      return model.latency(g, static_cast<node_id>(&n - g.nodes.data())) > 0 ? 1 : n.width;
    case operation::memory_read:
    case operation::memory_write:
      return n.kind == operation::memory_write && index == 1 ? 1 : memory_inputs(g, model, n.object);
    default:
      return 1;
  }
}

/// Inputs that one bit of operand `index` drives behind the wire `n`, a bit of which drives `behind`.
double inputs_behind(const graph& g, const node& n, std::size_t index, double behind) {
  const double width = g.nodes[n.operands[index]].width;
  switch (n.kind) {
    case operation::slice:
    case operation::extend_sign:
      return behind * n.width / width;
    case operation::select:  // of constants: every bit is the condition
      return behind * n.width;
    default:
      return behind;
  }
}

}  // namespace

double memory_inputs(const graph& g, const delay_model& model, dataflow::memory_id m) {
  const dataflow::memory& memory = g.memories[m];
  return model.storage(memory) == storage_kind::block ? model.blocks(memory.words, memory.width) : memory.width / 2.0;
}

std::vector<load> find_loads(const graph& g, const delay_model& model) {
  const std::size_t count = g.nodes.size();
  std::vector<std::vector<load>> by_node(count);  // what node `id` loads, wires as yet without weight
  std::vector<double> behind(count, 0);           // inputs that a bit of the node drives
  const auto is_constant = [&](node_id id) { return g.nodes[id].kind == operation::constant; };
  for (register_id r = 0; r < g.registers.size(); ++r) {
    behind[g.registers[r].next] += 1;
    behind[g.registers[r].enable] += g.registers[r].width;
  }
  for (node_id id = static_cast<node_id>(count); id-- > 0;) {
    const node& n = g.nodes[id];
    const bool wire = is_wire(g, id);
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      if (is_constant(operand)) continue;
      const double inputs = wire ? inputs_behind(g, n, i, behind[id]) : inputs_of(g, model, n, i);
      behind[operand] += inputs;
      by_node[id].push_back({operand, id, inputs, dataflow::is_write_enable(n, i)});
    }
  }
  std::vector<load> all;
  for (const std::vector<load>& loads : by_node) all.insert(all.end(), loads.begin(), loads.end());
  for (register_id r = 0; r < g.registers.size(); ++r) {
    const auto by = static_cast<reader>(count + r);
    const dataflow::register_state& state = g.registers[r];
    if (!is_constant(state.next)) all.push_back({state.next, by, 1});
    if (!is_constant(state.enable)) all.push_back({state.enable, by, static_cast<double>(state.width), true});
  }
  return all;
}

spread find_spread(const graph& g, const delay_model& model) {
  const delay_parameters& p = model.parameters();
  const std::size_t count = g.nodes.size();
  const std::vector<double> zeros(count, 0);
  std::vector<double> whole = zeros;
  spread found{zeros, zeros, zeros};
  for (const load& l : find_loads(g, model)) found.readers[l.value] += l.inputs;
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    // State with many readers is counted as if it had few: a recurrence cannot be pipelined, and what the state decides
    // outside of it is in flip-flops of its own.
    if (n.kind == operation::constant || n.kind == operation::register_value) continue;
    double operands = 0;
    for (const node_id operand : n.operands) operands = std::max(operands, whole[operand]);
    if (is_wire(g, id) && !n.operands.empty()) {
      whole[id] = operands;  // the value behind the wire has these readers, too
      continue;
    }
    whole[id] = p.spread_doubling * std::max(0.0, std::log2(std::max(1.0, found.readers[id]) / p.spread_from));
    found.before[id] = std::min(p.spread_of_copies * operands, p.most_spread_of_copies);
    // A RAM's word begins its stage: what comes after is its readers' `before`.
    if (model.latency(g, id) == 0) found.after[id] = (1 - p.spread_of_copies) * whole[id];
  }
  return found;
}

}  // namespace epiline::schedule
