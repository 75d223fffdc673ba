#include "emit/control.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;
using schedule::settled;

namespace {

/// Clocks from the end of `resetting` to the first issue, of which two rows of copies take two.
constexpr int after_state_reset = 4;

int most_hold(const module_design& m) { return std::max(m.s.hold, m.s.initiation_interval - 1); }

int settle_clocks(const module_design& m) { return m.s.hold - m.s.commit; }

/// After a reset nothing is issued until what was in flight has left the pipeline, state has its initial values and
/// what is computed from settled values is right: then valid bits need no reset, which would go to every stage.
int reset_clocks(const module_design& m) {
  return std::max(m.plan.last_valid, settle_clocks(m)) + 1 + after_state_reset;
}

unsigned hold_bits(const module_design& m) { return bits_for(std::max(most_hold(m), reset_clocks(m)) + 1); }

/// An iteration is issued when nothing holds it and all it reads is there.
void write_fire(module_text& m) {
  std::string conditions = "may_issue";
  for (std::size_t i = 0; i < m.g.ports.size(); ++i) {
    if (!m.g.ports[i].input) continue;
    const auto port = static_cast<dataflow::port_id>(i);
    const std::string& name = m.names.ports[i];
    std::string take;
    bool always = false;
    for (const node& n : m.g.nodes) {
      if (n.kind != operation::read || n.object != port) continue;
      always |= m.is_always(n.operands[0]);
      if (!take.empty()) take += " | ";
      take += m.values.operand(n.operands[0], 0);
    }
    if (take.empty()) take = "1'b0";
    m.line("  assign {}_take = fire & ({});", name, take);
    if (m.is_sampled(m.g.ports[i])) m.line("  assign {}_wanted = ~holding & ({});", name, take);
    const std::optional<node_id> need = m.is_sampled(m.g.ports[i]) ? std::nullopt : need_register(m, port);
    if (always) {
      conditions += fmt::format("\n    & {}_there", name);
    } else if (need) {
      // A flip-flop of its own says whether this input is waited for: the issue is one gate behind flip-flops.
      const dataflow::register_state& r = m.g.registers[m.g.nodes[*need].object];
      const std::string now = m.values.operand(*need, 0);
      const std::string later = m.is_always(r.enable) ? m.values.operand(r.next, 0)
                                                      : fmt::format("({} ? {} : {})", m.values.operand(r.enable, 0),
                                                                    m.values.operand(r.next, 0), now);
      m.line("  always @(posedge clk) begin");
      m.line("    {0}_served <= fire ? {0}_push | ({0}_there & ~({0}_ready & {1})) | {2}", name, now, inverted(later));
      m.line("      : {0}_push | {0}_there | {1};", name, inverted(now));
      m.line("  end");
      conditions += fmt::format("\n    & {}_served", name);
    } else if (take != "1'b0") {
      conditions += fmt::format("\n    & ({}_there | ~({}))", name, take);
    }
  }
  m.line("  assign fire = {};", conditions);
}

/// The clocks without an issue that an iteration, or a reset, wants after it.
void write_hold(module_text& m) {
  const unsigned width = hold_bits(m);
  const int after_any = m.s.initiation_interval - 1;
  const bool waits = m.g.patient != none && m.s.hold > 0;
  const std::string longest = literal(width, most_hold(m));
  std::string after = longest;
  std::string starts = after_any > 0 ? "fire | " : "";
  if (waits && after_any == 0) {
    // `hold` counts for nothing unless `holding`.
    starts = fmt::format("(fire & {}) | ", m.values.operand(m.g.patient, 0));
  } else if (waits) {
    after = fmt::format("({} ? {} : {})", m.values.operand(m.g.patient, 0), longest, literal(width, after_any));
  }
  std::string room;
  for (const output_fifo& f : m.plan.fifos) room += fmt::format(" & {}_room", m.names.ports[f.port]);
  m.line("  wire holding_next = {}(holding & (hold != {}));", starts, literal(width, 1));
  m.line("  always @(posedge clk) begin");
  if (starts.empty()) {
    m.line("    hold <= hold - {};", literal(width, 1));
  } else {
    m.line("    hold <= fire ? {} : hold - {};", after, literal(width, 1));
  }
  m.line("    holding <= holding_next;");
  m.line("    may_issue <= ~holding_next{};", room);
  m.line("    resetting <= resetting & (hold != {});", literal(width, after_state_reset));
  m.line("    if (rst) begin");
  m.line("      hold <= {};", literal(width, reset_clocks(m)));
  m.line("      holding <= 1'b1;");
  m.line("      may_issue <= 1'b0;");
  m.line("      resetting <= 1'b1;");
  m.line("    end");
  m.line("  end");
}

}  // namespace

void write_control_declarations(module_text& m) {
  m.title("control");
  m.line("  wire fire;                // an iteration is issued in this clock");
  // Nothing is in flight at power-up: memories keep the contents that they were given.
  m.line("  reg [{}:1] valid = {};  // which stages hold an iteration", m.plan.last_valid,
         literal(m.plan.last_valid, 0));
  m.line("  reg [{}:0] hold;           // clocks until the next issue may come", hold_bits(m) - 1);
  m.line("  reg holding;");
  m.line("  reg resetting;            // what was in flight at a reset leaves the pipeline");
  // 0 at power-up, as valid is: an iteration issued before the first reset could change what only power-up sets.
  m.line("  reg may_issue = 1'b0;     // not holding, and outputs have room");
}

void write_reset_rows(module_text& m) {
  if (!m.plan.has_reset_rows()) return;
  m.title("reset of the state: through two rows of flip-flops, near what they reset");
  module_text::move_list moves;
  m.write_flip_flops(
      {"early_state_reset", 1}, m.plan.early_reset_copies, [] { return std::string("resetting"); }, moves);
  m.write_flip_flops(
      {"state_reset", 1}, m.plan.reset_copies,
      [&] { return m.values.copy_of("early_state_reset", m.plan.early_reset_copies); }, moves);
  m.write_moves(moves);
}

std::optional<node_id> need_register(const module_design& m, dataflow::port_id port) {
  std::optional<node_id> need;
  for (const node& n : m.g.nodes) {
    if (n.kind != operation::read || n.object != port) continue;
    const node& predicate = m.g.nodes[n.operands[0]];
    if (need || predicate.kind != operation::register_value) return std::nullopt;
    if (m.s.register_stage[predicate.object] != 0 || m.s.register_update[predicate.object] != 0) return std::nullopt;
    need = n.operands[0];
  }
  return need;
}

void write_issue(module_text& m) {
  write_fire(m);
  write_hold(m);
}

void write_valids(module_text& m) {
  m.title("valid bits");
  const std::string before =
      m.plan.last_valid > 1 ? fmt::format("{{valid[{}:1], fire}}", m.plan.last_valid - 1) : "fire";
  m.line("  always @(posedge clk) valid <= {};", before);
}

void write_patient(module_text& m) {
  std::vector<register_id> patient;
  for (register_id r = 0; r < m.g.registers.size(); ++r) {
    if (m.s.register_stage[r] == settled) patient.push_back(r);
  }
  if (patient.empty()) return;
  m.title("registers that wait for the pipeline to drain");
  m.line("  wire commit = holding & (hold == {});", literal(hold_bits(m), settle_clocks(m) + 1));
  m.line("  always @(posedge clk) begin");
  m.line("    if (commit) begin");
  for (const register_id r : patient) m.line("      {} <= {};", m.names.registers[r], m.names.pending[r]);
  m.line("    end");
  std::string resets;
  for (const register_id r : patient) {
    if (!m.g.registers[r].initial) continue;
    fmt::format_to(std::back_inserter(resets), "      {} <= {};\n", m.names.registers[r],
                   literal(*m.g.registers[r].initial));
  }
  if (!resets.empty()) {
    m.line("    if ({}) begin", m.values.state_reset());
    m.out += resets;
    m.line("    end");
  }
  m.line("  end");
}

}  // namespace epiline::emit
