#include "dataflow/random_graph.hpp"

#include <llvm/ADT/SmallString.h>

#include <algorithm>
#include <array>
#include <optional>

#include "dataflow/interpreter.hpp"

namespace epiline::dataflow::testing {

namespace {

constexpr std::array<unsigned, 10> widths = {1, 2, 8, 31, 32, 33, 63, 64, 65, 130};

std::string text_of(const llvm::APInt& value) {
  llvm::SmallString<64> text;
  value.toStringUnsigned(text, 16);
  return text.str().str();
}

class generator {
 public:
  generator(std::uint64_t seed, const random_graph_options& options) : random_(seed), options_(options) {}

  graph run() {
    g_.name = "random";
    g_.files = {"random.cpp"};
    for (const unsigned width : widths) constant(random_value(random_, width));
    make_ports();
    make_registers();
    if (options_.memories) make_memories();
    make_table();
    for (unsigned i = 0; i < options_.operations; ++i) {
      add_random_operation();
      if (pick(8) == 0) add_pending_access();
    }
    while (!pending_.empty()) add_pending_access();
    finish();
    return std::move(g_);
  }

 private:
  std::uint64_t pick(std::uint64_t count) { return random_() % count; }
  unsigned any_width() { return widths[pick(widths.size())]; }

  node_id push(node n) {
    n.where = {0, static_cast<std::uint32_t>(g_.nodes.size() + 1)};
    g_.nodes.push_back(std::move(n));
    return static_cast<node_id>(g_.nodes.size() - 1);
  }

  node_id make(operation kind, unsigned width, std::vector<node_id> operands, std::uint32_t object = none) {
    node n;
    n.kind = kind;
    n.width = width;
    n.operands = std::move(operands);
    n.object = object;
    return push(std::move(n));
  }

  node_id constant(const llvm::APInt& value) {
    node n;
    n.width = value.getBitWidth();
    n.value = value;
    return push(std::move(n));
  }

  node_id slice(node_id a, unsigned low, unsigned width) {
    node n;
    n.kind = operation::slice;
    n.width = width;
    n.low = low;
    n.operands = {a};
    return push(std::move(n));
  }

  /// Any earlier value, later ones more often.
  node_id any_value() {
    for (;;) {
      const std::uint64_t back = std::min(pick(g_.nodes.size()), pick(g_.nodes.size()));
      const node_id id = static_cast<node_id>(g_.nodes.size() - 1 - back);
      if (g_.nodes[id].width != 0) return id;
    }
  }

  /// An earlier value brought to a width.
  node_id value_of(unsigned width) {
    for (unsigned attempt = 0; attempt < 4; ++attempt) {
      const node_id id = any_value();
      if (g_.nodes[id].width == width) return id;
    }
    const node_id id = any_value();
    const unsigned have = g_.nodes[id].width;
    if (have == width) return id;
    if (have > width) return slice(id, static_cast<unsigned>(pick(have - width + 1)), width);
    return make(pick(2) == 0 ? operation::extend_zero : operation::extend_sign, width, {id});
  }

  void make_ports() {
    for (unsigned i = 0; i < 6; ++i) {
      port p;
      p.input = i < 3;
      p.name = (p.input ? "in" : "out") + std::to_string(i);
      unsigned offset = 0;
      for (unsigned f = 0; f <= pick(2); ++f) {
        const unsigned width = any_width();
        p.fields.push_back({"f" + std::to_string(f), "t" + std::to_string(f), width, offset});
        offset += width;
      }
      p.width = offset;
      pending_.push_back({p.input ? operation::read : operation::write, static_cast<std::uint32_t>(g_.ports.size())});
      g_.ports.push_back(std::move(p));
    }
    add_pending_access();
  }

  void make_registers() {
    for (unsigned i = 0; i < 6; ++i) {
      register_state r;
      r.name = "r" + std::to_string(i);
      r.width = any_width();
      if (pick(4) != 0) r.initial = random_value(random_, r.width);
      r.resets = !r.initial || pick(8) != 0;
      make(operation::register_value, r.width, {}, i);
      g_.registers.push_back(std::move(r));
    }
  }

  void make_memories() {
    for (std::uint32_t i = 0; i < 3; ++i) {
      memory m;
      m.name = "m" + std::to_string(i);
      m.width = any_width();
      m.words = static_cast<unsigned>(1 + pick(9));
      if (pick(2) == 0)
        for (unsigned w = 0; w < m.words; ++w) m.initial.push_back(random_value(random_, m.width));
      g_.memories.push_back(std::move(m));
      for (unsigned r = 0; r < 1 + pick(3); ++r) pending_.push_back({operation::memory_read, i});
      pending_.push_back({operation::memory_write, i});
    }
  }

  void make_table() {
    table t;
    t.name = "t0";
    t.width = any_width();
    for (unsigned w = 0; w < 1 + pick(20); ++w) t.values.push_back(random_value(random_, t.width));
    g_.tables.push_back(std::move(t));
  }

  void add_pending_access() {
    if (pending_.empty()) return;
    const std::size_t i = pick(pending_.size());
    const auto [kind, object] = pending_[i];
    pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
    const node_id enable = value_of(1);
    if (kind == operation::read) {
      make(kind, g_.ports[object].width, {enable}, object);
    } else if (kind == operation::write) {
      make(kind, 0, {enable, value_of(g_.ports[object].width)}, object);
    } else {
      const node_id address = value_of(static_cast<unsigned>(1 + pick(4)));
      if (kind == operation::memory_read)
        make(kind, g_.memories[object].width, {address, enable}, object);
      else
        make(kind, 0, {address, value_of(g_.memories[object].width), enable}, object);
    }
  }

  void add_random_operation() {
    static constexpr std::array kinds = {operation::add,
                                         operation::subtract,
                                         operation::multiply,
                                         operation::add_or_subtract,
                                         operation::divide_unsigned,
                                         operation::divide_signed,
                                         operation::remainder_unsigned,
                                         operation::remainder_signed,
                                         operation::bit_and,
                                         operation::bit_or,
                                         operation::bit_xor,
                                         operation::bit_not,
                                         operation::shift_left,
                                         operation::shift_right_logical,
                                         operation::shift_right_arithmetic,
                                         operation::equal,
                                         operation::less_unsigned,
                                         operation::less_signed,
                                         operation::select,
                                         operation::concat,
                                         operation::slice,
                                         operation::extend_zero,
                                         operation::extend_sign,
                                         operation::table,
                                         operation::constant};
    const operation kind = kinds[pick(kinds.size())];
    const unsigned width = any_width();
    // Operands are made one after another: an argument list would leave their order to the compiler.
    const auto two = [&](unsigned w) {
      const node_id a = value_of(w);
      const node_id b = pick(4) == 0 ? constant(random_value(random_, w)) : value_of(w);
      return std::vector<node_id>{a, b};
    };
    switch (kind) {
      case operation::divide_unsigned:
      case operation::divide_signed:
      case operation::remainder_unsigned:
      case operation::remainder_signed:
        if (!options_.divisions) return;
        [[fallthrough]];
      case operation::add:
      case operation::subtract:
      case operation::multiply:
      case operation::bit_and:
      case operation::bit_or:
      case operation::bit_xor:
        make(kind, width, two(width));
        return;
      case operation::add_or_subtract: {
        std::vector<node_id> operands = two(width);
        operands.push_back(value_of(1));
        make(kind, width, std::move(operands));
        return;
      }
      case operation::bit_not:
        make(kind, width, {value_of(width)});
        return;
      case operation::shift_left:
      case operation::shift_right_logical:
      case operation::shift_right_arithmetic: {
        const node_id a = value_of(width);
        const unsigned amount_width = pick(3) == 0 ? any_width() : static_cast<unsigned>(1 + pick(7));
        const node_id amount = pick(3) == 0 ? constant(random_value(random_, amount_width)) : value_of(amount_width);
        make(kind, width, {a, amount});
        return;
      }
      case operation::equal:
      case operation::less_unsigned:
      case operation::less_signed:
        make(kind, 1, two(width));
        return;
      case operation::select: {
        const node_id condition = value_of(1);
        const auto arms = two(width);
        make(kind, width, {condition, arms[0], arms[1]});
        return;
      }
      case operation::concat: {
        std::vector<node_id> parts;
        unsigned sum = 0;
        for (unsigned i = 0; i < 2 + pick(3); ++i) {
          parts.push_back(value_of(any_width()));
          sum += g_.nodes[parts.back()].width;
        }
        make(kind, sum, parts);
        return;
      }
      case operation::slice: {
        const node_id a = any_value();
        const unsigned have = g_.nodes[a].width;
        const unsigned want = static_cast<unsigned>(1 + pick(have));
        slice(a, static_cast<unsigned>(pick(have - want + 1)), want);
        return;
      }
      case operation::extend_zero:
      case operation::extend_sign: {
        const node_id a = any_value();
        make(kind, g_.nodes[a].width + 1 + static_cast<unsigned>(pick(40)), {a});
        return;
      }
      case operation::table:
        make(kind, g_.tables[0].width, {value_of(static_cast<unsigned>(1 + pick(6)))}, 0);
        return;
      default:
        constant(random_value(random_, width));
    }
  }

  void add_output(const std::string& name, node_id value) {
    const unsigned width = g_.nodes[value].width;
    port p;
    p.input = false;
    p.name = name;
    p.width = width;
    p.fields = {{"v", "tdata", width, 0}};
    g_.ports.push_back(p);
    const node_id one = constant(llvm::APInt(1, 1));
    make(operation::write, 0, {one, value}, static_cast<port_id>(g_.ports.size() - 1));
  }

  void finish() {
    for (register_state& r : g_.registers) {
      r.next = value_of(r.width);
      r.enable = pick(3) == 0 ? value_of(1) : constant(llvm::APInt(1, 1));
    }
    for (const unsigned width : {8u, 33u, 130u}) add_output("always" + std::to_string(width), value_of(width));
    // Most values nothing uses come out too: a graph of which most is dead would test little.
    std::vector<char> used(g_.nodes.size(), 0);
    for (const node& n : g_.nodes)
      for (const node_id operand : n.operands) used[operand] = 1;
    std::vector<node_id> unused;
    unsigned sum = 0;
    for (node_id id = 0; id < used.size(); ++id) {
      if (used[id] || g_.nodes[id].width == 0 || pick(4) == 0) continue;
      if (sum + g_.nodes[id].width > max_width) break;
      sum += g_.nodes[id].width;
      unused.push_back(id);
    }
    if (unused.size() > 1) add_output("unused", make(operation::concat, sum, unused));
  }

  std::mt19937_64 random_;
  random_graph_options options_;
  graph g_;
  std::vector<std::pair<operation, std::uint32_t>> pending_;  // accesses every graph gets, at random places
};

}  // namespace

graph random_graph(std::uint64_t seed, const random_graph_options& options) { return generator(seed, options).run(); }

llvm::APInt random_value(std::mt19937_64& random, unsigned width) {
  llvm::APInt value(width, 0);
  switch (random() % 4) {
    case 0:
      for (unsigned i = 0; i < width; ++i) value.setBitVal(i, (random() & 1) != 0);
      return value;
    case 1:
      value.setBit(static_cast<unsigned>(random() % width));
      return value;
    case 2:
      return llvm::APInt(64, random() % 5).zextOrTrunc(width);
    default:
      return -llvm::APInt(64, random() % 5).zextOrTrunc(width);
  }
}

std::string find_difference(const graph& expected, const graph& actual, std::uint64_t seed, unsigned iterations) {
  if (auto what = find_violation(actual); !what.empty()) return "illegal graph: " + what;
  interpreter a(expected), b(actual);
  std::mt19937_64 random(seed);
  for (port_id id = 0; id < expected.ports.size(); ++id) {
    if (!expected.ports[id].input) continue;
    const port_id other = b.find_port(expected.ports[id].name, true);
    const std::uint64_t tokens = random() % 4 == 0 ? random() % iterations : iterations;  // some graphs block early
    for (unsigned i = 0; i < tokens; ++i) {
      const llvm::APInt token = random_value(random, expected.ports[id].width);
      a.push(id, token);
      if (other != none) b.push(other, token);
    }
  }
  const auto done_a = a.run_until_blocked(iterations);
  const auto done_b = b.run_until_blocked(iterations);
  if (done_a.last != done_b.last || done_a.iterations != done_b.iterations)
    return std::to_string(done_a.iterations) + " iterations became " + std::to_string(done_b.iterations) + "; " +
           a.message() + "; " + b.message();
  for (port_id id = 0; id < expected.ports.size(); ++id) {
    if (expected.ports[id].input) continue;
    const std::string& name = expected.ports[id].name;
    const port_id other = b.find_port(name, false);
    for (unsigned i = 0;; ++i) {
      const auto x = a.pop(id);
      const auto y = other == none ? std::nullopt : b.pop(other);
      if (!x && !y) break;
      if (!x || !y) return "port " + name + ": another number of tokens";
      if (*x != *y)
        return "port " + name + " token " + std::to_string(i) + ": " + text_of(*x) + " became " + text_of(*y);
    }
  }
  return {};
}

}  // namespace epiline::dataflow::testing
