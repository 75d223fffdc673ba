#include "dataflow/translate.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace epiline::dataflow {

namespace {

struct translator {
  explicit translator(const graph& source) : g(source) {}

  void run() {
    place_fixed_values();
    find_dependences();
    emit_batches();
    place_effects();
  }

  location allocate(unsigned width) {
    const auto offset = t.values.size();
    t.values.resize(offset + words_for(width), 0);
    return {static_cast<std::uint32_t>(offset), width};
  }

  bool narrow(const node& n) const { return n.width <= word_bits; }
  bool operands_narrow(const node& n) const {
    return std::all_of(n.operands.begin(), n.operands.end(), [&](node_id id) { return narrow(g.nodes[id]); });
  }

  /// Constants and registers have a place before any instruction runs.
  void place_fixed_values() {
    where.resize(g.nodes.size(), location{none, 0});
    for (const register_state& r : g.registers) t.registers.push_back(allocate(r.width));
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const node& n = g.nodes[id];
      if (n.kind == operation::register_value) where[id] = t.registers[n.object];
      if (n.kind != operation::constant) continue;
      where[id] = allocate(n.width);
      std::copy_n(n.value.getRawData(), words_for(n.width), &t.values[where[id].offset]);
    }
  }

  static bool is_fixed(const node& n) { return n.kind == operation::constant || n.kind == operation::register_value; }

  /// A write into a port, and a memory write no read of the same iteration follows, wait for the iteration's end.
  bool is_late(node_id id) const {
    const node& n = g.nodes[id];
    return n.kind == operation::write ||
           (n.kind == operation::memory_write && (last_read[n.object] == none || last_read[n.object] < id));
  }

  void depends(node_id user, node_id on) {
    if (is_fixed(g.nodes[on])) return;
    users[on].push_back(user);
    ++missing[user];
  }

  void find_dependences() {
    users.resize(g.nodes.size());
    missing.resize(g.nodes.size(), 0);
    last_read.resize(g.memories.size(), none);
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (g.nodes[id].kind == operation::memory_read) last_read[g.nodes[id].object] = id;
    std::vector<node_id> last_write(g.memories.size(), none);
    std::vector<std::vector<node_id>> reads_since(g.memories.size());
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const node& n = g.nodes[id];
      if (is_late(id)) continue;
      for (const node_id operand : n.operands) depends(id, operand);
      if (n.kind != operation::memory_read && n.kind != operation::memory_write) continue;
      if (last_write[n.object] != none) depends(id, last_write[n.object]);
      if (n.kind == operation::memory_read) {
        reads_since[n.object].push_back(id);
      } else {
        for (const node_id earlier : reads_since[n.object]) depends(id, earlier);
        reads_since[n.object].clear();
        last_write[n.object] = id;
      }
    }
  }

  opcode opcode_of(const node& n) const {
    if (n.kind == operation::read) return opcode::read;
    if (n.kind == operation::memory_read) return opcode::memory_read;
    if (n.kind == operation::memory_write) return opcode::memory_write;
    if (n.kind == operation::slice && narrow(n) && !operands_narrow(n)) return opcode::slice_of_wide;
    if (!narrow(n) || !operands_narrow(n)) return opcode::wide;
    switch (n.kind) {
      case operation::table:
        return opcode::table;
      case operation::concat:
        return opcode::concat;
      case operation::slice:
        return opcode::slice;
      case operation::extend_sign:
        return opcode::extend_sign;
      default:
        // The remaining narrow operations stand in the same order in both enumerations.
        static_assert(static_cast<int>(opcode::select) ==
                      static_cast<int>(operation::select) - static_cast<int>(operation::add));
        return static_cast<opcode>(static_cast<int>(n.kind) - static_cast<int>(operation::add));
    }
  }

  /// Emits ready nodes in runs of equal opcodes, each time the opcode with most nodes ready.
  void emit_batches() {
    std::array<std::vector<node_id>, static_cast<std::size_t>(opcode::count)> ready;
    std::vector<node_id> wires;  // narrow zero extensions take no instruction: they share their operand's place
    const auto enlist = [&](node_id id) {
      const node& n = g.nodes[id];
      if (n.kind == operation::extend_zero && narrow(n))
        wires.push_back(id);
      else
        ready[static_cast<std::size_t>(opcode_of(n))].push_back(id);
    };
    const auto release = [&](node_id id) {
      for (const node_id user : users[id])
        if (--missing[user] == 0) enlist(user);
    };
    const auto settle_wires = [&] {
      while (!wires.empty()) {
        const node_id wire = wires.back();
        wires.pop_back();
        where[wire] = {where[g.nodes[wire].operands[0]].offset, g.nodes[wire].width};
        release(wire);
      }
    };
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (!is_fixed(g.nodes[id]) && !is_late(id) && missing[id] == 0) enlist(id);
    settle_wires();
    for (;;) {
      const auto fullest = std::max_element(ready.begin(), ready.end(),
                                            [](const auto& a, const auto& b) { return a.size() < b.size(); });
      if (fullest->empty()) break;
      batch b{static_cast<opcode>(fullest - ready.begin()), static_cast<std::uint32_t>(t.instructions.size()), 0};
      for (std::size_t i = 0; i < fullest->size(); ++i) {  // grows while it runs
        const node_id id = (*fullest)[i];
        emit(b.what, id);
        release(id);
        settle_wires();
      }
      fullest->clear();
      b.end = static_cast<std::uint32_t>(t.instructions.size());
      t.batches.push_back(b);
    }
  }

  std::uint32_t offset(node_id id) const { return where[id].offset; }

  void emit(opcode what, node_id id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::memory_write) where[id] = allocate(n.width);
    instruction i;
    if (n.kind != operation::memory_write) i.result = offset(id);
    i.result_shift = static_cast<std::uint8_t>(word_bits - std::min(n.width, word_bits));
    switch (what) {
      case opcode::read:
        i.a = static_cast<std::uint32_t>(t.reads.size());
        t.reads.push_back({n.object, offset(n.operands[0]), where[id]});
        break;
      case opcode::memory_read:
      case opcode::memory_write:
        i.a = static_cast<std::uint32_t>(t.memory_accesses.size());
        t.memory_accesses.push_back(access_of(id));
        break;
      case opcode::wide: {
        i.a = static_cast<std::uint32_t>(t.wide.size());
        wide_instruction w{n.kind, n.low, where[id], {}, n.object};
        for (const node_id operand : n.operands) w.operands.push_back(where[operand]);
        t.wide.push_back(std::move(w));
        break;
      }
      case opcode::concat:
        emit_concat(n, i);
        return;
      default: {
        if (!n.operands.empty()) i.a = offset(n.operands[0]);
        if (n.operands.size() > 1) i.b = offset(n.operands[1]);
        if (n.operands.size() > 2) i.c = offset(n.operands[2]);
        const unsigned width = where[n.operands[0]].width;
        i.operand_shift = static_cast<std::uint8_t>(word_bits - std::min(width, word_bits));
        if (what == opcode::slice) i.operand_shift = static_cast<std::uint8_t>(n.low);
        if (what == opcode::slice_of_wide) {
          i.a += n.low / word_bits;
          i.operand_shift = static_cast<std::uint8_t>(n.low % word_bits);
        }
        if (what == opcode::table) i.b = n.object;
      }
    }
    t.instructions.push_back(i);
  }

  /// A narrow concat of n operands is n - 1 instructions (high << width of low | low) with one accumulator.
  void emit_concat(const node& n, instruction i) {
    std::uint32_t high = offset(n.operands[0]);
    for (std::size_t k = 1; k < n.operands.size(); ++k) {
      i.a = high;
      i.b = offset(n.operands[k]);
      i.operand_shift = static_cast<std::uint8_t>(where[n.operands[k]].width);
      t.instructions.push_back(i);
      high = i.result;
    }
  }

  memory_access access_of(node_id id) const {
    const node& n = g.nodes[id];
    const bool read = n.kind == operation::memory_read;
    return {n.object, where[n.operands[0]], read ? where[id] : where[n.operands[1]], offset(n.operands[read ? 1 : 2])};
  }

  void place_effects() {
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      if (!is_late(id)) continue;
      const node& n = g.nodes[id];
      if (n.kind == operation::write)
        t.writes.push_back({n.object, offset(n.operands[0]), where[n.operands[1]]});
      else
        t.late_writes.push_back(access_of(id));
    }
    for (register_id id = 0; id < g.registers.size(); ++id) {
      const location& value = t.registers[id];
      const register_update update{value.offset, offset(g.registers[id].next), offset(g.registers[id].enable),
                                   words_for(value.width)};
      (update.words == 1 ? t.narrow_updates : t.wide_updates).push_back(update);
      if (g.registers[id].patient) t.patient_registers.emplace_back(id, update.enable);
    }
    if (g.patient != none) t.patient = offset(g.patient);
  }

  translation t;
  const graph& g;
  std::vector<location> where;              // of each node's value
  std::vector<std::vector<node_id>> users;  // and memory accesses that must follow
  std::vector<unsigned> missing;            // operands not emitted yet
  std::vector<node_id> last_read;           // of each memory
};

}  // namespace

translation translate(const graph& g) {
  translator made(g);
  made.run();
  return std::move(made.t);
}

}  // namespace epiline::dataflow
