// What is known of values holds for every value that occurs; and the pass finds the widths it is for.
#include "passes/narrow_widths.hpp"

#include <gtest/gtest.h>

#include "dataflow/interpreter.hpp"
#include "dataflow/random_graph.hpp"
#include "dataflow/small_graph.hpp"
#include "passes/known_values.hpp"
#include "passes/simplify.hpp"

namespace epiline::passes {
namespace {

using namespace dataflow;
using dataflow::testing::small_graph;
using llvm::APInt;

TEST(known_values, contain_every_value_that_occurs) {
  std::uint64_t checked = 0, claims = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const graph g = testing::random_graph(seed, {.operations = 20 + static_cast<unsigned>(seed % 80)});
    const known_values known(g);
    graph watched = g;  // with an output for every value
    node always;
    always.width = 1;
    always.value = APInt(1, 1);
    watched.nodes.push_back(always);
    const auto one = static_cast<node_id>(watched.nodes.size() - 1);
    std::vector<port_id> output(g.nodes.size(), none);
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const unsigned width = g.nodes[id].width;
      if (width == 0) continue;
      output[id] = static_cast<port_id>(watched.ports.size());
      watched.ports.push_back({"n" + std::to_string(id), port_kind::stream, false, width, {{"v", "v", width, 0}}, {}});
      node write;
      write.kind = operation::write;
      write.operands = {one, id};
      write.object = output[id];
      watched.nodes.push_back(write);
    }
    interpreter run(watched);
    std::mt19937_64 random(seed);
    for (port_id p = 0; p < g.ports.size(); ++p)
      for (unsigned i = 0; g.ports[p].input && i < 20; ++i)
        run.push(p, testing::random_value(random, g.ports[p].width));
    run.run_until_blocked(20);
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      if (output[id] == none) continue;
      const value_set& set = known.of_node(id);
      claims += set.range.isFullSet() && set.bits.isUnknown() ? 0 : 1;
      while (const auto value = run.pop(output[id])) {
        ASSERT_TRUE(set.range.contains(*value) && (set.bits.One & ~*value).isZero() &&
                    (set.bits.Zero & *value).isZero())
            << "seed " << seed << " node " << id << " " << name_of(g.nodes[id].kind);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 50000u);
  EXPECT_GT(claims, 5000u);
}

}  // namespace
}  // namespace epiline::passes
