#pragma once
// Small graphs by hand, for the tests of the scheduler and the emitter.

#include <llvm/ADT/APInt.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "dataflow/small_graph.hpp"

namespace epiline::testing {

using dataflow::graph;
using dataflow::node_id;
using dataflow::operation;

/// Appends nodes in order; what is added gets the current source line.
class graph_builder : private dataflow::testing::small_graph {
 public:
  using small_graph::constant;
  using small_graph::g;
  unsigned line = 1;

  explicit graph_builder(std::string name) {
    g.name = std::move(name);
    g.files = {"kernel.cpp"};
  }

  node_id add(operation kind, unsigned width, std::vector<node_id> operands, std::uint32_t object = dataflow::none,
              unsigned low = 0) {
    const node_id id = make(kind, width, std::move(operands), object, low);
    g.nodes[id].where = {0, line};
    return id;
  }
  node_id always() { return constant(1, 1); }

  dataflow::port_id stream(std::string name, bool input, unsigned width) {
    return port(std::move(name), dataflow::port_kind::stream, input, {{"tdata", width}});
  }
  dataflow::port_id port(std::string name, dataflow::port_kind kind, bool input,
                         const std::vector<std::pair<std::string, unsigned>>& fields) {
    dataflow::port p;
    p.name = std::move(name);
    p.kind = kind;
    p.input = input;
    for (const auto& [signal, width] : fields) {
      p.fields.push_back({signal, signal, width, p.width});
      p.width += width;
    }
    p.where = {0, line};
    g.ports.push_back(std::move(p));
    return static_cast<dataflow::port_id>(g.ports.size() - 1);
  }
  node_id read(dataflow::port_id port, node_id predicate) {
    return add(operation::read, g.ports[port].width, {predicate}, port);
  }
  void write(dataflow::port_id port, node_id predicate, node_id token) {
    add(operation::write, 0, {predicate, token}, port);
  }

  /// A register and the node of its value; set() gives it its next value.
  std::pair<dataflow::register_id, node_id> state(const std::string& name, unsigned width, std::uint64_t initial) {
    const dataflow::register_id id = add_register(name, width, initial);
    g.registers[id].where = {0, line};
    return {id, add(operation::register_value, width, {}, id)};
  }
  void set(dataflow::register_id state, node_id next, node_id enable, bool patient = false) {
    update(state, next, enable);
    g.registers[state].patient = patient;
  }

  /// A memory full of zeros; a distance above 1 counts as promised.
  dataflow::memory_id memory(const std::string& name, unsigned words, unsigned width, unsigned distance) {
    const dataflow::memory_id id = add_memory(name, words, width);
    dataflow::memory& m = g.memories[id];
    m.distance = distance;
    m.distance_promised = distance > 1;
    m.initial.assign(words, llvm::APInt(width, 0));
    m.where = {0, line};
    return id;
  }
  node_id load(dataflow::memory_id memory, node_id address, node_id enable) {
    return add(operation::memory_read, g.memories[memory].width, {address, enable}, memory);
  }
  void store(dataflow::memory_id memory, node_id address, node_id data, node_id enable) {
    add(operation::memory_write, 0, {address, data, enable}, memory);
  }

  node_id binary(operation kind, node_id a, node_id b) { return add(kind, g.nodes[a].width, {a, b}); }
  node_id sum(node_id a, node_id b) { return binary(operation::add, a, b); }
  node_id compare(operation kind, node_id a, node_id b) { return add(kind, 1, {a, b}); }
  node_id select(node_id condition, node_id one, node_id zero) {
    return add(operation::select, g.nodes[one].width, {condition, one, zero});
  }
  node_id invert(node_id a) { return add(operation::bit_not, g.nodes[a].width, {a}); }
  node_id slice(node_id a, unsigned low, unsigned width) {
    return add(operation::slice, width, {a}, dataflow::none, low);
  }
  node_id extend(node_id a, unsigned width) { return add(operation::extend_zero, width, {a}); }
};

}  // namespace epiline::testing
