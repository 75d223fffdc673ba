#include "frontend/sort_nodes.hpp"

#include <utility>
#include <vector>

namespace epiline::frontend {

using dataflow::node_id;
using dataflow::operation;

void sort_nodes(dataflow::graph& graph) {
  std::vector<node_id> roots;
  for (node_id id = 0; id < graph.nodes.size(); ++id)
    if (const operation kind = graph.nodes[id].kind; kind == operation::write || kind == operation::read)
      roots.push_back(id);
  for (const dataflow::register_state& state : graph.registers) {
    roots.push_back(state.next);
    roots.push_back(state.enable);
  }
  if (graph.patient != dataflow::none) roots.push_back(graph.patient);
  for (node_id id = 0; id < graph.nodes.size(); ++id)
    if (graph.nodes[id].kind == operation::memory_write) roots.push_back(id);

  std::vector<node_id> placed(graph.nodes.size(), dataflow::none);
  std::vector<dataflow::node> sorted;
  const auto place = [&](node_id root) {
    std::vector<std::pair<node_id, std::size_t>> stack{{root, 0}};
    while (!stack.empty()) {
      const node_id id = stack.back().first;
      const std::size_t next = stack.back().second;
      if (placed[id] != dataflow::none) {
        stack.pop_back();
      } else if (next < graph.nodes[id].operands.size()) {
        ++stack.back().second;
        if (const node_id operand = graph.nodes[id].operands[next]; placed[operand] == dataflow::none)
          stack.emplace_back(operand, 0);
      } else {
        placed[id] = static_cast<node_id>(sorted.size());
        sorted.push_back(graph.nodes[id]);
        for (node_id& operand : sorted.back().operands) operand = placed[operand];
        stack.pop_back();
      }
    }
  };
  // Memory writes last: then every memory read stands before the write of its memory. Their operands first.
  for (const node_id root : roots) {
    if (graph.nodes[root].kind != operation::memory_write)
      place(root);
    else
      for (const node_id operand : graph.nodes[root].operands) place(operand);
  }
  for (const node_id root : roots)
    if (graph.nodes[root].kind == operation::memory_write) place(root);
  for (dataflow::register_state& state : graph.registers) {
    state.next = placed[state.next];
    state.enable = placed[state.enable];
  }
  if (graph.patient != dataflow::none) graph.patient = placed[graph.patient];
  graph.nodes = std::move(sorted);
}

}  // namespace epiline::frontend
