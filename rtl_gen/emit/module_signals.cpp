#include "emit/module_signals.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "emit/register_map.hpp"

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;
using dataflow::operation;
using dataflow::register_id;

namespace {

/// The line of a node and those of the operands whose text is part of its own.
void collect_lines(const module_text& m, node_id id, std::vector<dataflow::source_location>& lines) {
  const node& n = m.g.nodes[id];
  const bool is_new = std::none_of(lines.begin(), lines.end(), [&](const dataflow::source_location& known) {
    return known.file == n.where.file && known.line == n.where.line;
  });
  if (is_new && n.where.line != 0) lines.push_back(n.where);
  for (const node_id operand : n.operands) {
    if (m.values.is_inlined(operand)) collect_lines(m, operand, lines);
  }
}

}  // namespace

std::vector<signal> signals_of(const module_text& m) {
  std::vector<signal> all = interface_signals(m.g.name, m.interface);
  const auto control = [&](const char* name, const char* what, unsigned width) {
    all.push_back({name, "control", what, width, -1, {}});
  };
  control("fire", "1 when an iteration is issued", 1);
  control("valid", "which stages hold an iteration", 0);
  control("hold", "clocks until the next issue may come", 0);
  control("holding", "1 while no issue may come", 1);
  control("holding_next", "the next value of 'holding'", 1);
  control("may_issue", "1 when nothing but missing tokens keeps the next iteration from being issued", 1);
  control("resetting", "1 after a reset until what was in flight has left the pipeline", 1);
  control("commit", "1 when registers that wait for the pipeline change", 1);
  if (m.plan.has_reset_rows()) {
    control("early_state_reset", "the reset on its way to the state", 1);
    control("state_reset", "the reset of the state", 1);
  }
  for (std::size_t i = 0; i < m.g.ports.size(); ++i) {
    const dataflow::port& port = m.g.ports[i];
    all.push_back({m.names.ports[i], "port", port.input ? "input" : "output", port.width, -1, {port.where}});
  }
  if (m.options.axi_lite) {
    const register_map map = make_register_map(m.g);
    all.push_back({map.module(), "control", "the AXI4-Lite slave in front of the arguments", 0, -1, {}});
    for (const argument_register& argument : map.arguments) {
      const std::string what = fmt::format("argument '{}' behind the AXI4-Lite slave", argument.name);
      all.push_back({"argument_" + argument.name, "register", what, 0, -1, {}});
    }
    for (const char* inside :
         {"aw_there", "aw_waits", "w_there", "w_waits", "ar_there", "ar_waits", "write", "read", "write_word",
          "write_data", "write_strobe", "read_word", "calls", "arguments", "started", "start", "keep"}) {
      control(inside, "inside the AXI4-Lite slave", 0);
    }
  }
  for (register_id r = 0; r < m.g.registers.size(); ++r) {
    const dataflow::register_state& state = m.g.registers[r];
    std::vector<dataflow::source_location> lines;
    if (state.where.line != 0) lines.push_back(state.where);
    if (m.g.nodes[state.next].kind != operation::constant) collect_lines(m, state.next, lines);
    all.push_back({m.names.registers[r], "register", "", state.width, m.s.register_stage[r], std::move(lines)});
    if (!m.names.pending[r].empty() && m.names.pending[r] != m.names.registers[r] + "_pending") {
      all.push_back({m.names.pending[r], "register", "its next value", state.width, -1, {state.where}});
    }
  }
  for (std::size_t i = 0; i < m.g.memories.size(); ++i) {
    const dataflow::memory& memory = m.g.memories[i];
    for (const std::string& array : m.names.memories[i])
      all.push_back({array, "memory", fmt::format("{} words", memory.words), memory.width, -1, {memory.where}});
  }
  for (std::size_t t = 0; t < m.g.tables.size(); ++t) {
    const dataflow::table& table = m.g.tables[t];
    const std::string words = fmt::format("{} words", table.values.size());
    all.push_back({m.names.tables[t], "table", words, table.width, -1, {table.where}});
  }
  for (std::size_t i = 0; i < m.plan.lines.size(); ++i) {
    const delay_line& line = m.plan.lines[i];
    std::vector<dataflow::source_location> lines;
    for (const node_id id : line.values) collect_lines(m, id, lines);
    const std::string what = fmt::format("values that wait from stage {} to {}", line.from, line.to);
    all.push_back({m.names.delay_lines[i], "delay line", what, line.width, line.to, std::move(lines)});
  }
  std::set<int> lengths;
  for (const delay_line& line : m.plan.lines) lengths.insert(line.words());
  for (const int words : lengths) {
    const std::string what = fmt::format("pointer of the delay lines of {} words", words);
    for (const char* end : {"in", "out"}) {
      all.push_back({fmt::format("delay_{}_{}", words, end), "control", what, bits_for(words - 1), -1, {}});
    }
  }
  for (node_id id = 0; id < m.g.nodes.size(); ++id) {
    const node& n = m.g.nodes[id];
    if (m.names.nodes[id].empty() || n.kind == operation::register_value) continue;
    if (m.values.is_inlined(id) && m.plan.waits[id].empty()) continue;  // its text is part of others'
    std::vector<dataflow::source_location> lines;
    collect_lines(m, id, lines);
    all.push_back({m.names.nodes[id], "value", dataflow::name_of(n.kind), n.width, m.s.stage[id], std::move(lines)});
  }
  return all;
}

}  // namespace epiline::emit
