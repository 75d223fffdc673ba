#include "emit/state.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace epiline::emit {

using dataflow::node_id;
using dataflow::register_id;
using schedule::settled;

void declare_register(module_text& m, register_id r) {
  const dataflow::register_state& state = m.g.registers[r];
  const std::string at_power_up =
      state.initial && !is_reset(m.g, m.s, r) ? fmt::format(" = {}", literal(*state.initial)) : std::string();
  m.line("  reg {}{}{};{}", range_of(state.width), m.names.registers[r], at_power_up, m.comment(state.where));
}

void write_state(module_text& m, int stage) {
  const std::vector<register_id>& here = m.updates_at[stage];
  if (here.empty()) return;
  struct group {  // registers that the same signals enable
    std::string when, enable;
    std::vector<register_id> registers;
  };
  std::vector<group> groups;  // in order of appearance
  std::map<std::pair<std::string, std::string>, std::size_t> group_of;
  const auto read_by = [&](register_id r) { m.values.read_by(static_cast<schedule::reader>(m.g.nodes.size() + r)); };
  for (const register_id r : here) {
    read_by(r);
    const node_id condition = m.g.registers[r].enable;
    std::string when = m.values.update_bit(condition, stage);
    std::string enable;
    if (when.empty()) {
      when = m.values.valid(stage);
      if (!m.is_always(condition)) enable = m.values.whole(condition, stage);
    }
    const auto [found, fresh_group] = group_of.try_emplace({when, enable}, groups.size());
    if (fresh_group) groups.push_back({when, enable, {}});
    groups[found->second].registers.push_back(r);
  }
  const auto target = [&](register_id r) {
    return m.s.register_stage[r] == settled ? m.names.pending[r] : m.names.registers[r];
  };
  for (const register_id r : here) {
    if (m.s.register_stage[r] == settled) m.line("  reg {}{};", range_of(m.g.registers[r].width), m.names.pending[r]);
  }
  m.line("  always @(posedge clk) begin");
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const group& now = groups[i];
    if (i == 0 || groups[i - 1].when != now.when) m.line("    if ({}) begin", now.when);
    const bool conditional = !now.enable.empty();
    if (conditional) m.line("      if ({}) begin", now.enable);
    for (const register_id r : now.registers) {
      read_by(r);
      m.line("      {}{} <= {};{}", conditional ? "  " : "", target(r), m.values.whole(m.g.registers[r].next, stage),
             m.comment(m.g.registers[r].where));
    }
    if (conditional) m.line("      end");
    if (i + 1 == groups.size() || groups[i + 1].when != now.when) m.line("    end");
  }
  std::string open;  // the reset whose block is open
  for (const register_id r : here) {
    if (!is_reset(m.g, m.s, r)) continue;
    read_by(r);
    const std::string reset = m.values.state_reset();
    if (reset != open) {
      if (!open.empty()) m.line("    end");
      m.line("    if ({}) begin", reset);
      open = reset;
    }
    m.line("      {} <= {};", target(r), literal(*m.g.registers[r].initial));
  }
  if (!open.empty()) m.line("    end");
  m.values.read_by(0);
  m.line("  end");
}

}  // namespace epiline::emit
