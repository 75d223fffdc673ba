#pragma once
// What the tests of single passes share: a graph from one expression, and what became of that expression.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "dataflow/random_graph.hpp"
#include "dataflow/small_graph.hpp"

namespace epiline::passes::testing {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::testing::small_graph;

/// Nodes of one kind.
inline std::size_t count(const graph& g, operation kind) {
  std::size_t result = 0;
  for (const node& n : g.nodes) result += n.kind == kind ? 1 : 0;
  return result;
}

/// Width of the only node of a kind; 0 if there is none, a failure if there are several.
inline unsigned width_of(const graph& g, operation kind) {
  unsigned width = 0;
  for (const node& n : g.nodes) {
    if (n.kind != kind) continue;
    EXPECT_EQ(width, 0u) << "several nodes of kind " << name_of(kind);
    width = n.width;
  }
  return width;
}

/// What is written to the only output, as an expression: "add.9(a, b)", "c.8:15" for a constant, names for inputs and
/// registers.
inline std::string expression(const graph& g, node_id id) {
  const node& n = g.nodes[id];
  if (n.kind == operation::read) return g.ports[n.object].name;
  if (n.kind == operation::register_value) return g.registers[n.object].name;
  if (n.kind == operation::constant) {
    return "c." + std::to_string(n.width) + ":" + std::to_string(n.value.getLimitedValue());
  }
  std::string text = std::string(name_of(n.kind)) + "." + std::to_string(n.width);
  if (n.kind == operation::slice) text += "@" + std::to_string(n.low);
  text += "(";
  for (std::size_t i = 0; i < n.operands.size(); ++i) text += (i == 0 ? "" : ", ") + expression(g, n.operands[i]);
  return text + ")";
}
inline std::string output_expression(const graph& g) {
  for (const node& n : g.nodes)
    if (n.kind == operation::write) return expression(g, n.operands[1]);
  return "nothing";
}

/// Inputs a, b (8 bits), p, q (1 bit) and one output of what `make` builds from them.
inline small_graph graph_of(
    const std::function<node_id(small_graph&, node_id a, node_id b, node_id p, node_id q)>& make) {
  small_graph s;
  const node_id a = s.read("a", 8), b = s.read("b", 8), p = s.read("p", 1), q = s.read("q", 1);
  s.write("out", make(s, a, b, p, q));
  return s;
}

/// Runs `pass` on `before` and checks that the result outputs the same.
inline graph run(const graph& before, const std::function<void(graph&)>& pass) {
  graph after = before;
  pass(after);
  EXPECT_EQ(dataflow::testing::find_difference(before, after, 1, 300), "");
  return after;
}

}  // namespace epiline::passes::testing
