#include "passes/forward_memories.hpp"

#include <fmt/format.h>

#include "passes/builder.hpp"
#include "passes/known_values.hpp"

namespace epiline::passes {

namespace {

/// 1 when both addresses are the same.
node_id same_address(builder& b, node_id x, node_id y) {
  const unsigned width = std::max(b.width(x), b.width(y));
  return b.equal(b.resize_zero(x, width), b.resize_zero(y, width));
}

/// 1 when an address lies within the memory. `known` is what is known about it.
node_id in_memory(builder& b, node_id address, const dataflow::memory& m, const value_set& known) {
  if (known.bits.getMaxValue().ult(m.words) || known.range.getUnsignedMax().ult(m.words)) return b.bit(true);
  const unsigned width = std::max(b.width(address), 33u);
  return b.less_unsigned(b.resize_zero(address, width), b.constant(width, m.words));
}

/// The write node of each memory, or none.
std::vector<node_id> writes_of(const graph& g) {
  std::vector<node_id> writes(g.memories.size(), none);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::memory_write) continue;
    if (writes[n.object] != none) {
      const dataflow::memory& m = g.memories[n.object];
      throw memory_error(fmt::format("{}:{}: memory '{}' is written more than once in an iteration",
                                     m.where.file < g.files.size() ? g.files[m.where.file] : "?", m.where.line,
                                     m.name));
    }
    writes[n.object] = id;
  }
  return writes;
}

/// Memories whose write depends on a read of the same memory within the iteration.
std::vector<char> read_modify_write(const graph& g, const std::vector<node_id>& writes) {
  std::vector<char> result(g.memories.size(), 0);
  for (memory_id m = 0; m < g.memories.size(); ++m) {
    if (writes[m] == none || g.memories[m].distance != 1 || g.memories[m].distance_promised) continue;
    std::vector<char> seen(g.nodes.size(), 0);
    std::vector<node_id> pending = g.nodes[writes[m]].operands;
    while (!pending.empty() && !result[m]) {
      const node_id id = pending.back();
      pending.pop_back();
      if (seen[id]) continue;
      seen[id] = 1;
      result[m] = g.nodes[id].kind == operation::memory_read && g.nodes[id].object == m;
      pending.insert(pending.end(), g.nodes[id].operands.begin(), g.nodes[id].operands.end());
    }
  }
  return result;
}

}  // namespace

void order_memory_accesses(graph& g) {
  const std::vector<node_id> writes = writes_of(g);
  bool in_order = true;
  for (node_id id = 0; id < g.nodes.size(); ++id)
    if (g.nodes[id].kind == operation::memory_read && writes[g.nodes[id].object] < id) in_order = false;
  if (in_order) return;
  const known_values known(g);
  std::vector<node> pending(g.memories.size());  // the write met so far, with operands of the new graph
  rebuild(
      g,
      [&](builder& b, node n, node_id id) {
        if (n.kind == operation::memory_write) {
          pending[n.object] = std::move(n);
          return none;
        }
        if (n.kind != operation::memory_read || writes[n.object] > id) return b.make(std::move(n));
        const node& write = pending[n.object];
        const node_id address = n.operands[0], enable = n.operands[1];
        const node_id hit =
            b.bit_and(b.bit_and(write.operands[2], enable), same_address(b, write.operands[0], address));
        const node_id there = in_memory(b, address, g.memories[n.object], known.of_node(g.nodes[id].operands[0]));
        return b.select(b.bit_and(hit, there), write.operands[1], b.make(std::move(n)));
      },
      {},
      [&](builder& b) {
        for (node& write : pending)
          if (write.kind == operation::memory_write) b.make(std::move(write));
      });
}

void forward_memories(graph& g, unsigned writes_kept) {
  const std::vector<node_id> writes = writes_of(g);
  const std::vector<char> forward = read_modify_write(g, writes);
  if (writes_kept == 0 || std::find(forward.begin(), forward.end(), 1) == forward.end()) return;
  const known_values known(g);
  struct kept_write {
    register_id enable, address, data;
  };
  std::vector<std::vector<kept_write>> kept(g.memories.size());  // youngest first
  for (memory_id m = 0; m < g.memories.size(); ++m) {
    if (!forward[m]) continue;
    g.memories[m].distance = 1 + writes_kept;
    const unsigned address_width = g.nodes[g.nodes[writes[m]].operands[0]].width;
    for (unsigned i = 0; i < writes_kept; ++i) {
      const auto add = [&](const char* what, unsigned width, bool starts_at_zero) {
        dataflow::register_state r;
        r.name = fmt::format("{}_last_{}_{}", g.memories[m].name, what, i + 1);
        r.width = width;
        if (starts_at_zero) r.initial = llvm::APInt(width, 0);
        r.next = r.enable = 0;  // set at the end
        r.where = g.memories[m].where;
        g.registers.push_back(std::move(r));
        return static_cast<register_id>(g.registers.size() - 1);
      };
      const register_id enable = add("enable", 1, true), address = add("address", address_width, false);
      kept[m].push_back({enable, address, add("data", g.memories[m].width, false)});
    }
  }
  std::vector<node> met(g.memories.size());
  rebuild(
      g,
      [&](builder& b, node n, node_id id) {
        if (n.kind == operation::memory_write) met[n.object] = n;
        if (n.kind != operation::memory_read || !forward[n.object]) return b.make(std::move(n));
        const memory_id m = n.object;
        const node_id address = n.operands[0];
        const node_id there = in_memory(b, address, g.memories[m], known.of_node(g.nodes[id].operands[0]));
        const node_id wanted = b.bit_and(n.operands[1], there);
        node_id word = b.make(std::move(n));
        for (auto k = kept[m].rbegin(); k != kept[m].rend(); ++k) {  // younger writes win
          const node_id hit =
              b.bit_and(b.register_value(k->enable), same_address(b, b.register_value(k->address), address));
          word = b.select(b.bit_and(wanted, hit), b.register_value(k->data), word);
        }
        return word;
      },
      {},
      [&](builder& b) {
        const auto update = [&](register_id r, node_id next) {
          b.target().registers[r].next = next;
          b.target().registers[r].enable = b.bit(true);
        };
        for (memory_id m = 0; m < kept.size(); ++m)
          for (std::size_t i = 0; i < kept[m].size(); ++i) {
            const node& write = met[m];
            update(kept[m][i].enable, i == 0 ? write.operands[2] : b.register_value(kept[m][i - 1].enable));
            update(kept[m][i].address, i == 0 ? write.operands[0] : b.register_value(kept[m][i - 1].address));
            update(kept[m][i].data, i == 0 ? write.operands[1] : b.register_value(kept[m][i - 1].data));
          }
      });
}

}  // namespace epiline::passes
