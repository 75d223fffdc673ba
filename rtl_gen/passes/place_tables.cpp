#include "passes/place_tables.hpp"

#include <vector>

#include "passes/cycles.hpp"

namespace epiline::passes {

using dataflow::node_id;
using dataflow::operation;

namespace {

/// The nodes that the predicates of reads depend on within an iteration.
std::vector<bool> decides_reads(const dataflow::graph& g) {
  std::vector<bool> decides(g.nodes.size(), false);
  for (node_id id = static_cast<node_id>(g.nodes.size()); id-- > 0;) {  // users before operands
    if (!decides[id] && g.nodes[id].kind != operation::read) continue;
    for (const node_id operand : g.nodes[id].operands) decides[operand] = true;
  }
  return decides;
}

}  // namespace

void place_tables(dataflow::graph& g) {
  const std::vector<std::uint32_t> cycles = cycles_of(g);
  const std::vector<bool> decides = decides_reads(g);
  for (node_id id = 0; id < g.nodes.size(); ++id)
    if (g.nodes[id].kind == operation::table && (cycles[id] != dataflow::none || decides[id]))
      g.tables[g.nodes[id].object].immediate = true;
}

}  // namespace epiline::passes
