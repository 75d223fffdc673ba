#pragma once
// Networks made by hand, for tests.

#include <string>

#include "dataflow/network.hpp"
#include "dataflow/small_graph.hpp"

namespace epiline::dataflow::testing {

/// Sends a token of `in` to `odd` or `even` by its lowest bit.
inline graph sorter() {
  small_graph s;
  s.g.name = "sorter";
  const node_id token = s.read("in", 8);
  const node_id odd = s.make(operation::slice, 1, {token}, none, 0);
  const node_id even = s.make(operation::bit_not, 1, {odd});
  s.write("odd", token, odd);
  s.write("even", token, even);
  return s.g;
}

/// Takes from `even` and from `odd` in turn, and writes what it took.
inline graph merger() {
  small_graph s;
  s.g.name = "merger";
  const register_id turn = s.add_register("turn", 1, 0);
  const node_id odd_next = s.value_of(turn);
  const node_id even_next = s.make(operation::bit_not, 1, {odd_next});
  s.update(turn, even_next);
  const node_id even = s.read("even", 8, even_next);
  const node_id odd = s.read("odd", 8, odd_next);
  s.write("out", s.make(operation::select, 8, {odd_next, odd, even}));
  return s.g;
}

inline port outer(const std::string& name, bool input) {
  return {name, port_kind::stream, input, 8, {{"value", "tdata", 8, 0}}, {0, 3}};
}

inline network sort_and_merge(unsigned depth) {
  network n;
  n.name = "sort_and_merge";
  n.files = {"some \"place\".cpp"};
  n.ports = {outer("in", true), outer("out", false)};
  n.fifos = {{"odd", 8, depth, {0, 11}}, {"even", 8, 2 * depth, {}}};
  n.processes = {sorter(), merger()};
  n.called = {{0, 20}, {0, 21}};
  return n;
}

/// A process that adds its scalar to every token; a call for each.
inline graph adder(const std::string& name, const std::string& in, const std::string& out, const std::string& scalar) {
  small_graph s;
  s.g.name = name;
  const node_id token = s.read(in, 8);
  const node_id amount = s.read("call", 8);
  s.g.ports.back() = {"call", port_kind::call, true, 8, {{scalar, scalar, 8, 0}}, {}};
  s.write(out, s.make(operation::add, 8, {token, amount}));
  return s.g;
}

inline network two_adders() {
  network n;
  n.name = "two_adders";
  n.ports = {
      outer("in", true),
      outer("out", false),
      {"call", port_kind::call, true, 20, {{"unused", "unused", 4, 0}, {"b", "b", 8, 4}, {"a", "a", 8, 12}}, {}}};
  n.fifos = {{"between", 8, 2, {}}};
  n.processes = {adder("first", "in", "between", "a"), adder("second", "between", "out", "b")};
  n.called.resize(2);
  return n;
}

}  // namespace epiline::dataflow::testing
