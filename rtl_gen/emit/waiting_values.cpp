#include "emit/waiting_values.hpp"

#include <string>

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;
using dataflow::operation;
using schedule::storage_kind;

namespace {

using move_list = module_text::move_list;

/// Flip-flops that hold in this stage what the stage before had.
void write_values(module_text& m, int stage, move_list& moves) {
  for (node_id id = 0; id < m.g.nodes.size(); ++id) {
    for (const wait_step& step : m.plan.waits[id]) {
      if (step.line >= 0 || stage <= step.from || stage > step.to) continue;
      const std::string name = stage_name(m.names.nodes[id], stage);
      const auto all = m.plan.value_copies.find({id, stage});
      m.write_flip_flops(
          {name, m.g.nodes[id].width}, all == m.plan.value_copies.end() ? copies{{0}} : all->second,
          [&] { return m.values.whole(id, stage - 1); }, moves);
    }
  }
}

void write_valid_copies(module_text& m, int stage) {
  if (stage > m.plan.last_valid) return;
  const copies& all = m.plan.valid_copies[stage];
  for (std::size_t copy = 1; copy < all.count(); ++copy) {
    m.values.read_by(all.first_reader[copy]);
    m.write_copy(copy_name(fmt::format("valid_s{}", stage), copy), 1, m.values.valid(stage - 1));
  }
}

void write_update_bits(module_text& m, int stage, move_list& moves) {
  for (const auto& [place, all] : m.plan.update_bits) {
    if (place.second != stage) continue;
    const auto source = [&] {
      return fmt::format("{} & {}", m.values.valid(stage - 1), m.values.operand(place.first, stage - 1));
    };
    // Its copies are 0 at power-up, too: nothing changes state before the first reset.
    m.write_flip_flops({m.names.update_bits.at(place), 1, m.g.nodes[place.first].where, true}, all, source, moves);
  }
}

/// Delay lines that end here.
void write_delay_lines(module_text& m, int stage, move_list& moves) {
  for (std::size_t i = 0; i < m.plan.lines.size(); ++i) {
    const delay_line& l = m.plan.lines[i];
    if (l.to != stage) continue;
    const bool block = l.storage == storage_kind::block;
    const std::string& name = m.names.delay_lines[i];
    m.line("  (* ram_style = \"{}\", no_rw_check *)", block ? "block" : "distributed");
    m.line("  reg {}{} [0:{}];", range_of(l.width), name, l.words() - 1);
    if (block) m.line("  reg {}{}_q;", range_of(l.width), name);
    std::string data;
    for (std::size_t v = l.values.size(); v-- > 0;) {
      const node_id id = l.values[v];
      m.line("  reg {}{};", range_of(m.g.nodes[id].width), stage_name(m.names.nodes[id], stage));
      if (!data.empty()) data += ", ";
      data += m.values.whole(id, l.from);
    }
    if (l.values.size() > 1) data = "{" + data + "}";
    std::string target;
    for (std::size_t v = l.values.size(); v-- > 0;) {
      if (!target.empty()) target += ", ";
      target += stage_name(m.names.nodes[l.values[v]], stage);
    }
    if (l.values.size() > 1) target = "{" + target + "}";
    moves.emplace_back(fmt::format("{}[{}]", name, pointer_name(l, "in")), data);
    const std::string word = fmt::format("{}[{}]", name, pointer_name(l, "out"));
    if (block) {
      moves.emplace_back(name + "_q", word);
      moves.emplace_back(target, name + "_q");
    } else {
      moves.emplace_back(target, word);
    }
  }
}

/// Words of block RAMs and tables whose address stood two stages earlier.
void write_words(module_text& m, int stage, move_list& moves) {
  for (std::size_t i = 0; i < m.g.memories.size(); ++i) {
    if (m.plan.memories[i].storage != storage_kind::block) continue;
    for (const read_port& port : m.plan.memories[i].reads) {
      if (port.stage + 2 != stage) continue;
      const std::string first = m.names.nodes[port.reads[0]];
      for (const node_id id : port.reads) {
        m.line("  reg {}{};{}", range_of(m.g.nodes[id].width), m.names.nodes[id], m.comment(m.g.nodes[id].where));
        moves.emplace_back(m.names.nodes[id], first + "_q");
      }
    }
  }
  for (node_id id = 0; id < m.g.nodes.size(); ++id) {
    const node& n = m.g.nodes[id];
    if (n.kind != operation::table || m.s.available[id] == m.s.stage[id] || m.s.available[id] != stage) continue;
    m.line("  reg {}{};{}", range_of(n.width), m.names.nodes[id], m.comment(n.where));
    moves.emplace_back(m.names.nodes[id], m.names.nodes[id] + "_q");
  }
}

}  // namespace

void write_waiting_values(module_text& m, int stage) {
  move_list moves;
  write_values(m, stage, moves);
  write_valid_copies(m, stage);
  write_update_bits(m, stage, moves);
  m.values.read_by(0);
  write_delay_lines(m, stage, moves);
  write_words(m, stage, moves);
  m.write_moves(moves);
}

}  // namespace epiline::emit
