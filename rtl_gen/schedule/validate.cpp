// schedule.hpp's validate(). On purpose it shares nothing with what finds schedules but the delays: it would share the
// faults, too.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "schedule/schedule.hpp"
#include "schedule/timing.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

namespace {

std::string complain(const graph& g, node_id id, const std::string& text) {
  return fmt::format("node {} ({}): {}", id, dataflow::name_of(g.nodes[id].kind), text);
}

/// Accesses to one port or one memory: in one stage where they share hardware, in the order of the source otherwise.
std::string find_access_violation(const graph& g, const result& s) {
  std::vector<int> port_stage(g.ports.size(), -1);
  std::vector<int> first_read(g.memories.size(), INT32_MAX), last_read(g.memories.size(), -1);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind == operation::write) {
      if (port_stage[n.object] >= 0 && port_stage[n.object] != s.stage[id])
        return complain(g, id, "port's stages differ");
      port_stage[n.object] = s.stage[id];
    }
    if (n.kind == operation::memory_read) {
      first_read[n.object] = std::min(first_read[n.object], s.stage[id]);
      last_read[n.object] = std::max(last_read[n.object], s.stage[id]);
    }
  }
  std::vector<int> write_stage(g.memories.size(), -1);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::memory_write) continue;
    const std::int64_t window = static_cast<std::int64_t>(g.memories[n.object].distance) * s.initiation_interval - 1;
    if (last_read[n.object] > s.stage[id]) return complain(g, id, "written before an earlier iteration's read");
    if (last_read[n.object] >= 0 && s.stage[id] - first_read[n.object] > window) {
      return complain(g, id, "written too late for a later iteration's read");
    }
    if (write_stage[n.object] >= 0 && write_stage[n.object] != s.stage[id]) {
      return complain(g, id, "another write to the memory is in another stage");
    }
    write_stage[n.object] = s.stage[id];
  }
  return {};
}

}  // namespace

std::string validate(const graph& g, const delay_model& model, const result& s) {
  const std::size_t count = g.nodes.size();
  if (s.stage.size() != count || s.available.size() != count || s.settle_level.size() != count ||
      s.register_stage.size() != g.registers.size() || s.register_update.size() != g.registers.size()) {
    return "the schedule is of another graph";
  }
  const auto settled_or_at = [&](node_id value, int stage) {
    return s.stage[value] == settled || s.available[value] <= stage;
  };
  int settle = 0;
  std::vector<int> last_settled_use(count, -1);
  bool any_patient = false;
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (s.stage[id] == settled) {
      const bool movable = n.kind != operation::read && n.kind != operation::write &&
                           n.kind != operation::memory_read && n.kind != operation::memory_write;
      if (!movable) return complain(g, id, "an access cannot be settled");
      if (n.kind == operation::register_value && (g.patient == none || !g.registers[n.object].patient)) {
        return complain(g, id, "the register is not patient, so its value is not settled");
      }
      int level = 0;
      for (const node_id operand : n.operands) {
        if (s.stage[operand] != settled) return complain(g, id, "settled, but an operand is not");
        level = std::max(level, s.settle_level[operand]);
      }
      if (s.settle_level[id] < level + (is_settled_register(g, s, id) ? 1 : 0))
        return complain(g, id, "settles too early");
      settle = std::max(settle, s.settle_level[id]);
      continue;
    }
    if (s.stage[id] < 0 || s.available[id] >= s.depth) return complain(g, id, "outside the pipeline");
    if (s.available[id] != s.stage[id] + model.latency(g, id)) return complain(g, id, "wrong latency");
    for (const node_id operand : n.operands) {
      if (!settled_or_at(operand, s.stage[id])) return complain(g, id, fmt::format("works before operand {}", operand));
      if (s.stage[operand] == settled) last_settled_use[operand] = std::max(last_settled_use[operand], s.stage[id]);
    }
    if (n.kind == operation::read && s.stage[id] != 0) return complain(g, id, "a read outside stage 0");
    if (n.kind == operation::register_value && s.stage[id] != s.register_stage[n.object]) {
      return complain(g, id, "not in its register's stage");
    }
  }
  if (g.patient != none && !settled_or_at(g.patient, 0)) return complain(g, g.patient, "the patient mark is late");
  for (register_id r = 0; r < g.registers.size(); ++r) {
    const dataflow::register_state& state = g.registers[r];
    const int update = s.register_update[r];
    for (const node_id source : {state.next, state.enable}) {
      if (!settled_or_at(source, update)) return fmt::format("register {}: updated before its input is there", r);
      if (s.stage[source] == settled) last_settled_use[source] = std::max(last_settled_use[source], update);
    }
    if (update < 0 || update >= s.depth) return fmt::format("register {}: updated outside the pipeline", r);
    if (g.patient != none && state.patient) {
      any_patient = true;
      if (update >= s.commit) return fmt::format("register {}: committed before its next value is there", r);
      continue;
    }
    const int late = update - s.register_stage[r];
    if (late < 0 || late >= s.initiation_interval) return fmt::format("register {}: its recurrence does not close", r);
  }
  for (node_id id = 0; id < count; ++id) {
    if (any_patient && g.nodes[id].kind != operation::constant && last_settled_use[id] > s.commit) {
      return complain(g, id, "a settled value changes while an iteration uses it");
    }
  }
  if (any_patient && s.hold < s.commit + settle) return "iterations are issued before settled values are right";
  if (std::string wrong = find_access_violation(g, s); !wrong.empty()) return wrong;
  const timing t = analyse(g, model, s);
  if (t.worst > s.period + 2 * tolerance) {
    return complain(g, t.worst_end, fmt::format("its chain takes {:.2f} ns of {:.2f} ns", t.worst, s.period));
  }
  return {};
}

}  // namespace epiline::schedule
