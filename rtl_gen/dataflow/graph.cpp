#include "dataflow/graph.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace epiline::dataflow {

namespace {

constexpr std::array operation_names = {"constant",
                                        "read",
                                        "write",
                                        "register_value",
                                        "memory_read",
                                        "memory_write",
                                        "table",
                                        "add",
                                        "subtract",
                                        "multiply",
                                        "add_or_subtract",
                                        "divide_unsigned",
                                        "divide_signed",
                                        "remainder_unsigned",
                                        "remainder_signed",
                                        "bit_and",
                                        "bit_or",
                                        "bit_xor",
                                        "bit_not",
                                        "shift_left",
                                        "shift_right_logical",
                                        "shift_right_arithmetic",
                                        "equal",
                                        "less_unsigned",
                                        "less_signed",
                                        "select",
                                        "concat",
                                        "slice",
                                        "extend_zero",
                                        "extend_sign"};
static_assert(operation_names.size() == static_cast<std::size_t>(operation::extend_sign) + 1);

bool width_allowed(unsigned width) { return width >= 1 && width <= max_width; }

/// Finds the first broken rule; every member returns an empty string when its part of the graph keeps the rules.
class checker {
 public:
  explicit checker(const graph& g) : g_(g), accesses_(g.ports.size(), 0) {}

  std::string run() {
    for (std::size_t i = 0; i < g_.ports.size(); ++i)
      if (auto what = check_port(g_.ports[i]); !what.empty())
        return fmt::format("port {} '{}'{}: {}", i, g_.ports[i].name, place(g_.ports[i].where), what);
    for (std::size_t i = 0; i < g_.memories.size(); ++i)
      if (auto what = check_memory(g_.memories[i]); !what.empty())
        return fmt::format("memory {} '{}'{}: {}", i, g_.memories[i].name, place(g_.memories[i].where), what);
    for (std::size_t i = 0; i < g_.tables.size(); ++i)
      if (auto what = check_table(g_.tables[i]); !what.empty())
        return fmt::format("table {} '{}'{}: {}", i, g_.tables[i].name, place(g_.tables[i].where), what);
    for (node_id id = 0; id < g_.nodes.size(); ++id)
      if (auto what = check_node(id); !what.empty())
        return fmt::format("node {} ({}){}: {}", id, name_of(g_.nodes[id].kind), place(g_.nodes[id].where), what);
    for (std::size_t i = 0; i < g_.registers.size(); ++i)
      if (auto what = check_register(g_.registers[i]); !what.empty())
        return fmt::format("register {} '{}'{}: {}", i, g_.registers[i].name, place(g_.registers[i].where), what);
    if (g_.patient != none) {
      if (g_.patient >= g_.nodes.size()) return fmt::format("patient: there is no node {}", g_.patient);
      if (g_.nodes[g_.patient].width != 1) return fmt::format("patient: node {} is not one bit wide", g_.patient);
    }
    return {};
  }

 private:
  std::string place(const source_location& where) const {
    if (where.line == 0) return {};
    if (where.file >= g_.files.size()) return fmt::format(" (file {}, line {})", where.file, where.line);
    return fmt::format(" ({}:{})", g_.files[where.file], where.line);
  }

  std::string check_location(const source_location& where) const {
    if (where.line != 0 && where.file >= g_.files.size()) return fmt::format("there is no file {}", where.file);
    return {};
  }

  std::string check_port(const port& p) const {
    if (auto what = check_location(p.where); !what.empty()) return what;
    if (!width_allowed(p.width)) return fmt::format("width {} is not in 1..{}", p.width, max_width);
    if (p.kind == port_kind::call && !p.input) return "a call port must be an input";
    if (p.kind == port_kind::result && p.input) return "a result port must be an output";
    unsigned offset = 0;
    for (const field& f : p.fields) {
      if (!width_allowed(f.width))
        return fmt::format("field '{}': width {} is not in 1..{}", f.name, f.width, max_width);
      if (f.offset != offset) return fmt::format("field '{}' starts at bit {} instead of {}", f.name, f.offset, offset);
      if (f.width > p.width - offset) return fmt::format("field '{}' reaches past the token's end", f.name);
      offset += f.width;
    }
    if (offset != p.width) return fmt::format("the fields have {} bits, the token {}", offset, p.width);
    return {};
  }

  std::string check_memory(const memory& m) const {
    if (auto what = check_location(m.where); !what.empty()) return what;
    if (!width_allowed(m.width)) return fmt::format("width {} is not in 1..{}", m.width, max_width);
    if (m.words == 0) return "it has no words";
    if (m.distance == 0) return "distance 0, which must be at least 1";
    if (!m.initial.empty() && m.initial.size() != m.words)
      return fmt::format("{} initial values for {} words", m.initial.size(), m.words);
    for (const llvm::APInt& value : m.initial)
      if (value.getBitWidth() != m.width)
        return fmt::format("an initial value has {} bits instead of {}", value.getBitWidth(), m.width);
    return {};
  }

  std::string check_table(const table& t) const {
    if (auto what = check_location(t.where); !what.empty()) return what;
    if (!width_allowed(t.width)) return fmt::format("width {} is not in 1..{}", t.width, max_width);
    for (const llvm::APInt& value : t.values)
      if (value.getBitWidth() != t.width)
        return fmt::format("a value has {} bits instead of {}", value.getBitWidth(), t.width);
    return {};
  }

  std::string check_register(const register_state& r) const {
    if (auto what = check_location(r.where); !what.empty()) return what;
    if (!width_allowed(r.width)) return fmt::format("width {} is not in 1..{}", r.width, max_width);
    if (r.initial && r.initial->getBitWidth() != r.width)
      return fmt::format("the initial value has {} bits instead of {}", r.initial->getBitWidth(), r.width);
    if (r.next >= g_.nodes.size()) return "its next value is no node";
    if (r.enable >= g_.nodes.size()) return "its enable is no node";
    if (g_.nodes[r.next].width != r.width)
      return fmt::format("its next value has {} bits instead of {}", g_.nodes[r.next].width, r.width);
    if (g_.nodes[r.enable].width != 1) return "its enable is not one bit wide";
    if (r.patient && g_.patient == none) return "it is patient but no iteration is marked patient";
    return {};
  }

  unsigned operand_width(const node& n, std::size_t i) const { return g_.nodes[n.operands[i]].width; }

  /// Checks the number of operands and, where `widths` is not 0, their widths.
  std::string expect(const node& n, std::initializer_list<unsigned> widths) const {
    if (n.operands.size() != widths.size())
      return fmt::format("{} operands instead of {}", n.operands.size(), widths.size());
    std::size_t i = 0;
    for (const unsigned width : widths) {
      if (width != 0 && operand_width(n, i) != width)
        return fmt::format("operand {} has {} bits instead of {}", i, operand_width(n, i), width);
      ++i;
    }
    return {};
  }

  std::string check_access(node_id id) {
    const node& n = g_.nodes[id];
    if (n.object >= g_.ports.size()) return fmt::format("there is no port {}", n.object);
    const port& p = g_.ports[n.object];
    if (accesses_[n.object]++ != 0) return fmt::format("port '{}' is accessed a second time", p.name);
    if (n.kind == operation::read) {
      if (!p.input) return fmt::format("port '{}' is an output", p.name);
      if (n.width != p.width) return fmt::format("{} bits, the token of '{}' {}", n.width, p.name, p.width);
      return expect(n, {1});
    }
    if (p.input) return fmt::format("port '{}' is an input", p.name);
    return expect(n, {1, p.width});
  }

  std::string check_node(node_id id) {
    const node& n = g_.nodes[id];
    if (static_cast<std::size_t>(n.kind) >= operation_names.size()) return "the operation is unknown";
    if (auto what = check_location(n.where); !what.empty()) return what;
    const bool effect = n.kind == operation::write || n.kind == operation::memory_write;
    if (effect ? n.width != 0 : !width_allowed(n.width))
      return fmt::format("width {} is not {}", n.width, effect ? "0" : fmt::format("in 1..{}", max_width));
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      if (n.operands[i] >= id) return fmt::format("operand {} (node {}) does not stand before it", i, n.operands[i]);
      if (operand_width(n, i) == 0) return fmt::format("operand {} (node {}) has no value", i, n.operands[i]);
    }
    switch (n.kind) {
      case operation::constant:
        if (n.value.getBitWidth() != n.width)
          return fmt::format("the value has {} bits instead of {}", n.value.getBitWidth(), n.width);
        return expect(n, {});
      case operation::read:
      case operation::write:
        return check_access(id);
      case operation::register_value:
        if (n.object >= g_.registers.size()) return fmt::format("there is no register {}", n.object);
        if (n.width != g_.registers[n.object].width)
          return fmt::format("{} bits, the register {}", n.width, g_.registers[n.object].width);
        return expect(n, {});
      case operation::memory_read:
      case operation::memory_write:
        if (n.object >= g_.memories.size()) return fmt::format("there is no memory {}", n.object);
        if (n.kind == operation::memory_write) return expect(n, {0, g_.memories[n.object].width, 1});
        if (n.width != g_.memories[n.object].width)
          return fmt::format("{} bits, a word of the memory {}", n.width, g_.memories[n.object].width);
        return expect(n, {0, 1});
      case operation::table:
        if (n.object >= g_.tables.size()) return fmt::format("there is no table {}", n.object);
        if (n.width != g_.tables[n.object].width)
          return fmt::format("{} bits, a word of the table {}", n.width, g_.tables[n.object].width);
        return expect(n, {0});
      case operation::add:
      case operation::subtract:
      case operation::multiply:
      case operation::divide_unsigned:
      case operation::divide_signed:
      case operation::remainder_unsigned:
      case operation::remainder_signed:
      case operation::bit_and:
      case operation::bit_or:
      case operation::bit_xor:
        return expect(n, {n.width, n.width});
      case operation::add_or_subtract:
        return expect(n, {n.width, n.width, 1});
      case operation::bit_not:
        return expect(n, {n.width});
      case operation::shift_left:
      case operation::shift_right_logical:
      case operation::shift_right_arithmetic:
        return expect(n, {n.width, 0});
      case operation::equal:
      case operation::less_unsigned:
      case operation::less_signed:
        if (n.width != 1) return "the result must be one bit wide";
        if (n.operands.size() == 2) return expect(n, {operand_width(n, 1), 0});
        return expect(n, {0, 0});
      case operation::select:
        return expect(n, {1, n.width, n.width});
      case operation::concat: {
        if (n.operands.size() < 2) return "it needs at least two operands";
        std::uint64_t sum = 0;
        for (const node_id operand : n.operands) sum += g_.nodes[operand].width;
        if (sum != n.width) return fmt::format("{} bits, its operands {}", n.width, sum);
        return {};
      }
      case operation::slice:
        if (auto what = expect(n, {0}); !what.empty()) return what;
        if (n.low >= operand_width(n, 0) || n.width > operand_width(n, 0) - n.low)
          return fmt::format("bits {} and {} more of an operand of {}", n.low, n.width, operand_width(n, 0));
        return {};
      case operation::extend_zero:
      case operation::extend_sign:
        if (auto what = expect(n, {0}); !what.empty()) return what;
        if (n.width <= operand_width(n, 0))
          return fmt::format("it does not widen its operand of {} bits", operand_width(n, 0));
        return {};
    }
    return {};
  }

  const graph& g_;
  std::vector<unsigned> accesses_;  // of each port, so far
};

}  // namespace

const char* name_of(operation kind) {
  const auto index = static_cast<std::size_t>(kind);
  return index < operation_names.size() ? operation_names[index] : "unknown";
}

const char* name_of(port_kind kind) {
  switch (kind) {
    case port_kind::stream:
      return "stream";
    case port_kind::call:
      return "call";
    case port_kind::result:
      return "result";
  }
  return "unknown";
}

std::string find_violation(const graph& g) { return checker(g).run(); }

}  // namespace epiline::dataflow
