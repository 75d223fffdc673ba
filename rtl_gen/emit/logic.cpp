#include "emit/logic.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "emit/state.hpp"

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;
using dataflow::operation;
using dataflow::register_id;
using schedule::settled;
using schedule::storage_kind;

namespace {

void write_node(module_text& m, node_id id) {
  m.values.read_by(id);
  const node& n = m.g.nodes[id];
  const int stage = m.s.stage[id];
  const std::string& name = m.names.nodes[id];
  const std::string range = range_of(n.width);
  const std::string note = m.comment(n.where);
  switch (n.kind) {
    case operation::constant:
    case operation::register_value:
    case operation::write:
    case operation::memory_write:
      return;
    case operation::read: {
      const std::string token = m.names.ports[n.object] + "_token";
      if (m.is_always(n.operands[0])) {
        m.line("  wire {}{} = {};{}", range, name, token, note);
      } else {
        m.line("  wire {}{} = {} ? {} : {};{}", range, name, m.values.operand(n.operands[0], stage), token,
               literal(n.width, 0), note);
      }
      return;
    }
    case operation::memory_read:
      if (m.plan.memories[n.object].storage != storage_kind::block) {
        m.line("  wire {}{} = {}[{}];{}", range, name, m.array_read_by(id),
               m.values.index(n.operands[0], stage, m.g.memories[n.object].words), note);
      }
      return;
    case operation::table: {
      const dataflow::table& table = m.g.tables[n.object];
      const std::uint64_t words = std::bit_ceil(table.values.size());
      const unsigned needed = bits_for(words - 1);
      const unsigned width = m.g.nodes[n.operands[0]].width;
      std::string word = fmt::format("{}[{}]", m.names.tables[n.object], m.values.index(n.operands[0], stage, words));
      if (width > needed) {  // past the end
        word = fmt::format("({} == {}) ? {} : {}",
                           m.values.part(m.values.at(n.operands[0], stage), n.operands[0], needed, width - needed),
                           literal(width - needed, 0), word, literal(n.width, 0));
      }
      if (m.s.available[id] == stage) {
        m.line("  wire {}{} = {};{}", range, name, word, note);
      } else {
        m.line("  reg {}{}_q;", range, name);
        m.line("  always @(posedge clk) {}_q <= {};", name, word);
      }
      return;
    }
    case operation::add_or_subtract:
      m.adds_or_subtracts = true;
      m.line("  wire {}{};{}", range, name, note);
      m.line("  epiline_add_or_subtract #(.WIDTH({})) {} (.a({}), .b({}), .subtract({}), .total({}));", n.width,
             m.names.fresh(name + "_adder"), m.values.whole(n.operands[0], stage), m.values.whole(n.operands[1], stage),
             m.values.whole(n.operands[2], stage), name);
      return;
    case operation::divide_unsigned:
    case operation::divide_signed:
    case operation::remainder_unsigned:
    case operation::remainder_signed: {
      const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
      m.line("  wire {}{}_exact = {};", range, name, m.values.expression(id).text);
      const std::string by_zero =
          quotient ? fmt::format("{{{}{{1'b1}}}}", n.width) : m.values.operand(n.operands[0], stage);
      m.line("  wire {}{} = ({} == {}) ? {} : {}_exact;{}", range, name, m.values.operand(n.operands[1], stage),
             literal(n.width, 0), by_zero, name, note);
      return;
    }
    default:
      break;
  }
  m.line("  wire {}{} = {};{}", range, name, m.values.expression(id).text, note);
}

}  // namespace

void write_settled(module_text& m) {
  std::vector<node_id> logic;
  for (node_id id = 0; id < m.g.nodes.size(); ++id) {
    if (m.s.stage[id] == settled && m.g.nodes[id].kind != operation::constant &&
        m.g.nodes[id].kind != operation::register_value) {
      logic.push_back(id);
    }
  }
  bool any = !logic.empty();
  for (register_id r = 0; r < m.g.registers.size(); ++r) any |= m.s.register_stage[r] == settled;
  if (!any) return;
  m.title("values that change only while no iteration is in flight");
  for (register_id r = 0; r < m.g.registers.size(); ++r) {
    if (m.s.register_stage[r] == settled) declare_register(m, r);
  }
  std::vector<node_id> clocked;
  for (const node_id id : logic) {
    const node& n = m.g.nodes[id];
    if (m.values.is_inlined(id)) continue;
    if (schedule::is_settled_register(m.g, m.s, id)) {
      m.line("  reg {}{};{}", range_of(n.width), m.names.nodes[id], m.comment(n.where));
      clocked.push_back(id);
    } else {
      write_node(m, id);
    }
  }
  if (clocked.empty()) return;
  m.line("  always @(posedge clk) begin");
  for (const node_id id : clocked) {
    const node& n = m.g.nodes[id];
    const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
    const bool remainder = n.kind == operation::remainder_unsigned || n.kind == operation::remainder_signed;
    m.line("    {} <= {};", m.names.nodes[id], m.values.expression(id).text);
    if (quotient || remainder) {
      const std::string by_zero =
          quotient ? fmt::format("{{{}{{1'b1}}}}", n.width) : m.values.whole(n.operands[0], settled);
      m.line("    if ({} == {}) {} <= {};", m.values.operand(n.operands[1], settled), literal(n.width, 0),
             m.names.nodes[id], by_zero);
    }
  }
  m.line("  end");
}

void write_logic(module_text& m, int stage) {
  for (const node_id id : m.nodes_at[stage]) {
    if (!m.values.is_inlined(id)) write_node(m, id);
  }
}

}  // namespace epiline::emit
