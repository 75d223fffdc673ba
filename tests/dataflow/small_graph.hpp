#pragma once
// Builds graphs by hand, for tests: each call appends one node.

#include <string>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::dataflow::testing {

struct small_graph {
  graph g;
  static constexpr source_location where{0, 7};

  small_graph() {
    g.name = "small";
    g.files = {"small.cpp"};
  }

  node_id make(operation kind, unsigned width, std::vector<node_id> operands, std::uint32_t object = none,
               unsigned low = 0) {
    node n;
    n.kind = kind;
    n.width = width;
    n.operands = std::move(operands);
    n.object = object;
    n.low = low;
    n.where = where;
    g.nodes.push_back(std::move(n));
    return static_cast<node_id>(g.nodes.size() - 1);
  }

  node_id constant(unsigned width, std::uint64_t value) { return constant(llvm::APInt(64, value).zextOrTrunc(width)); }
  node_id constant(const llvm::APInt& value) {
    const node_id id = make(operation::constant, value.getBitWidth(), {});
    g.nodes[id].value = value;
    return id;
  }

  port_id add_port(const std::string& name, unsigned width, bool input) {
    g.ports.push_back({name, port_kind::stream, input, width, {{"value", "tdata", width, 0}}, where});
    return static_cast<port_id>(g.ports.size() - 1);
  }
  /// An input port read in every iteration.
  node_id read(const std::string& name, unsigned width) { return read(name, width, constant(1, 1)); }
  node_id read(const std::string& name, unsigned width, node_id predicate) {
    return make(operation::read, width, {predicate}, add_port(name, width, true));
  }
  /// An output port written in every iteration.
  node_id write(const std::string& name, node_id token) { return write(name, token, constant(1, 1)); }
  node_id write(const std::string& name, node_id token, node_id predicate) {
    return make(operation::write, 0, {predicate, token}, add_port(name, g.nodes[token].width, false));
  }

  register_id add_register(const std::string& name, unsigned width, std::uint64_t initial) {
    register_state r;
    r.name = name;
    r.width = width;
    r.initial = llvm::APInt(64, initial).zextOrTrunc(width);
    r.where = where;
    g.registers.push_back(std::move(r));
    return static_cast<register_id>(g.registers.size() - 1);
  }
  node_id value_of(register_id id) { return make(operation::register_value, g.registers[id].width, {}, id); }
  void update(register_id id, node_id next) { update(id, next, constant(1, 1)); }
  void update(register_id id, node_id next, node_id enable) {
    g.registers[id].next = next;
    g.registers[id].enable = enable;
  }

  memory_id add_memory(const std::string& name, unsigned words, unsigned width) {
    memory m;
    m.name = name;
    m.words = words;
    m.width = width;
    m.where = where;
    g.memories.push_back(std::move(m));
    return static_cast<memory_id>(g.memories.size() - 1);
  }
};

}  // namespace epiline::dataflow::testing
