// Tarjan's algorithm with an explicit stack: graphs are deeper than a call stack.
#include "passes/cycles.hpp"

#include <algorithm>

namespace epiline::passes {

using namespace dataflow;

std::vector<std::uint32_t> cycles_of(const graph& g) {
  const std::size_t count = g.nodes.size();
  std::vector<std::vector<node_id>> written(g.memories.size());  // what the words of each memory depend on
  for (const node& n : g.nodes)
    if (n.kind == operation::memory_write)
      written[n.object].insert(written[n.object].end(), n.operands.begin(), n.operands.end());
  // The i-th node that `id` depends on, in this or an earlier iteration, or none past the last.
  const auto source = [&](node_id id, std::size_t i) -> node_id {
    const node& n = g.nodes[id];
    if (i < n.operands.size()) return n.operands[i];
    i -= n.operands.size();
    if (n.kind == operation::register_value)
      return i == 0 ? g.registers[n.object].next : i == 1 ? g.registers[n.object].enable : none;
    if (n.kind == operation::memory_read && i < written[n.object].size()) return written[n.object][i];
    return none;
  };

  struct frame {
    node_id id;
    std::size_t next_source;
  };
  std::vector<std::uint32_t> cycle(count, none), order(count, none), lowest(count, 0);
  std::vector<char> on_stack(count, 0);
  std::vector<node_id> stack;
  std::vector<frame> calls;
  std::uint32_t visited = 0, cycles = 0;
  const auto enter = [&](node_id id) {
    order[id] = lowest[id] = visited++;
    stack.push_back(id);
    on_stack[id] = 1;
    calls.push_back({id, 0});
  };
  for (node_id start = 0; start < count; ++start) {
    if (order[start] == none) enter(start);
    while (!calls.empty()) {
      const node_id id = calls.back().id;
      const node_id next = source(id, calls.back().next_source++);
      if (next != none) {
        if (order[next] == none)
          enter(next);
        else if (on_stack[next])
          lowest[id] = std::min(lowest[id], order[next]);
        continue;
      }
      calls.pop_back();
      if (!calls.empty()) lowest[calls.back().id] = std::min(lowest[calls.back().id], lowest[id]);
      if (lowest[id] != order[id]) continue;
      const bool alone = stack.back() == id;  // a node cannot depend on itself but through a register's own node
      for (node_id member = none; member != id;) {
        member = stack.back();
        stack.pop_back();
        on_stack[member] = 0;
        if (!alone) cycle[member] = cycles;
      }
      if (!alone) ++cycles;
    }
  }
  return cycle;
}

}  // namespace epiline::passes
