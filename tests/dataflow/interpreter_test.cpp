// The interpreter against a machine written straight from graph.hpp's text, and its own behaviour (waiting, promises,
// queues, errors).
#include "dataflow/interpreter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <map>

#include "dataflow/evaluate.hpp"
#include "dataflow/random_graph.hpp"
#include "dataflow/small_graph.hpp"

namespace epiline::dataflow {
namespace {

using llvm::APInt;
using testing::small_graph;

/// Word for word what graph.hpp says, on APInt and maps; nothing is shared with the interpreter but evaluate().
class plain_machine {
 public:
  explicit plain_machine(const graph& g) : g_(g) {
    for (const register_state& r : g.registers) registers_.push_back(r.initial.value_or(APInt(r.width, 0)));
    for (const memory& m : g.memories)
      memories_.push_back(m.initial.empty() ? std::vector<APInt>(m.words, APInt(m.width, 0)) : m.initial);
    in.resize(g.ports.size());
    out.resize(g.ports.size());
  }

  bool step() {
    std::vector<APInt> value(g_.nodes.size(), APInt(1, 0));
    auto memories = memories_;
    for (node_id id = 0; id < g_.nodes.size(); ++id) {
      const node& n = g_.nodes[id];
      const auto operand = [&](std::size_t i) { return value[n.operands[i]]; };
      switch (n.kind) {
        case operation::constant:
          value[id] = n.value;
          break;
        case operation::read:
          if (operand(0).isOne() && in[n.object].empty()) return false;
          value[id] = operand(0).isOne() ? in[n.object].front() : APInt(n.width, 0);
          break;
        case operation::write:
          break;
        case operation::register_value:
          value[id] = registers_[n.object];
          break;
        case operation::memory_read: {
          const std::uint64_t address = operand(0).getLimitedValue();
          const bool there = operand(1).isOne() && address < memories[n.object].size();
          value[id] = there ? memories[n.object][address] : APInt(n.width, 0);
          break;
        }
        case operation::memory_write: {
          const std::uint64_t address = operand(0).getLimitedValue();
          if (operand(2).isOne() && address < memories[n.object].size()) memories[n.object][address] = operand(1);
          break;
        }
        case operation::table: {
          const std::uint64_t address = operand(0).getLimitedValue();
          const auto& words = g_.tables[n.object].values;
          value[id] = address < words.size() ? words[address] : APInt(n.width, 0);
          break;
        }
        default: {
          std::vector<APInt> operands;
          for (const node_id o : n.operands) operands.push_back(value[o]);
          value[id] = evaluate(n.kind, n.width, n.low, operands);
        }
      }
    }
    for (const node& n : g_.nodes) {
      if (n.kind == operation::read && value[n.operands[0]].isOne()) in[n.object].pop_front();
      if (n.kind == operation::write && value[n.operands[0]].isOne()) out[n.object].push_back(value[n.operands[1]]);
    }
    memories_ = memories;
    for (register_id id = 0; id < g_.registers.size(); ++id)
      if (value[g_.registers[id].enable].isOne()) registers_[id] = value[g_.registers[id].next];
    return true;
  }

  std::vector<APInt> registers_;
  std::vector<std::vector<APInt>> memories_;
  std::vector<std::deque<APInt>> in, out;

 private:
  const graph& g_;
};

TEST(interpreter, agrees_with_the_definition_on_random_graphs) {
  std::uint64_t blocked = 0, tokens = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const graph g = testing::random_graph(seed);
    ASSERT_EQ(find_violation(g), "");
    interpreter fast(g);
    plain_machine plain(g);
    std::mt19937_64 random(seed);
    for (unsigned i = 0; i < 40; ++i) {
      for (port_id p = 0; p < g.ports.size(); ++p) {
        if (!g.ports[p].input || random() % 4 == 0) continue;
        const APInt token = testing::random_value(random, g.ports[p].width);
        fast.push(p, token);
        plain.in[p].push_back(token);
      }
      const bool advanced = plain.step();
      blocked += advanced ? 0 : 1;
      ASSERT_EQ(fast.step(), advanced ? outcome::advanced : outcome::blocked);
      for (register_id r = 0; r < g.registers.size(); ++r) ASSERT_EQ(fast.register_value(r), plain.registers_[r]);
      for (memory_id m = 0; m < g.memories.size(); ++m)
        for (unsigned w = 0; w < g.memories[m].words; ++w) ASSERT_EQ(fast.memory_word(m, w), plain.memories_[m][w]);
    }
    for (port_id p = 0; p < g.ports.size(); ++p) {
      if (g.ports[p].input) {
        ASSERT_EQ(fast.available(p), plain.in[p].size());
        continue;
      }
      ASSERT_EQ(fast.available(p), plain.out[p].size());
      for (const APInt& token : plain.out[p]) {
        ASSERT_EQ(fast.pop(p), token);
        ++tokens;
      }
    }
  }
  EXPECT_GT(blocked, 100u);  // both outcomes were exercised
  EXPECT_GT(tokens, 10000u);
}

/// One node of `kind` on two inputs of `width` bits (amount: `width` too) gives `expected(a, b)` for all values.
template <class Function>
void check_exhaustively(operation kind, unsigned width, unsigned result_width, Function expected) {
  small_graph s;
  const node_id a = s.read("a", width), b = s.read("b", width);
  s.write("out", s.make(kind, result_width, {a, b}));
  interpreter run(s.g);
  const auto mask = (std::uint64_t{1} << result_width) - 1;
  for (std::uint64_t x = 0; x < std::uint64_t{1} << width; ++x)
    for (std::uint64_t y = 0; y < std::uint64_t{1} << width; ++y) {
      run.push(run.find_port("a", true), x);
      run.push(run.find_port("b", true), y);
      ASSERT_EQ(run.step(), outcome::advanced);
      const auto want =
          static_cast<std::uint64_t>(expected(static_cast<std::int64_t>(x), static_cast<std::int64_t>(y))) & mask;
      const std::vector<APInt> operands = {APInt(width, x), APInt(width, y)};
      ASSERT_EQ(run.pop_word(run.find_port("out", false)), want)
          << name_of(kind) << ' ' << width << ": " << x << ", " << y;
      ASSERT_EQ(evaluate(kind, result_width, 0, operands), APInt(result_width, want)) << name_of(kind);
    }
}

TEST(interpreter, arithmetic_is_exact_on_all_small_values) {
  for (unsigned width = 1; width <= 5; ++width) {
    const std::int64_t ones = (std::int64_t{1} << width) - 1;
    const auto s = [&](std::int64_t v) { return v >> (width - 1) != 0 ? v - ones - 1 : v; };
    const auto check = [&](operation kind, auto f) { check_exhaustively(kind, width, width, f); };
    const auto check_bit = [&](operation kind, auto f) { check_exhaustively(kind, width, 1, f); };
    check(operation::add, [](auto a, auto b) { return a + b; });
    check(operation::subtract, [](auto a, auto b) { return a - b; });
    check(operation::multiply, [](auto a, auto b) { return a * b; });
    check(operation::divide_unsigned, [&](auto a, auto b) { return b == 0 ? ones : a / b; });
    check(operation::divide_signed, [&](auto a, auto b) { return b == 0 ? ones : s(a) / s(b); });
    check(operation::remainder_unsigned, [](auto a, auto b) { return b == 0 ? a : a % b; });
    check(operation::remainder_signed, [&](auto a, auto b) { return b == 0 ? a : s(a) % s(b); });
    check(operation::bit_and, [](auto a, auto b) { return a & b; });
    check(operation::bit_or, [](auto a, auto b) { return a | b; });
    check(operation::bit_xor, [](auto a, auto b) { return a ^ b; });
    check(operation::shift_left, [](auto a, auto b) { return a << b; });
    check(operation::shift_right_logical, [](auto a, auto b) { return a >> b; });
    check(operation::shift_right_arithmetic, [&](auto a, auto b) { return s(a) >> b; });
    check_bit(operation::equal, [](auto a, auto b) { return a == b; });
    check_bit(operation::less_unsigned, [](auto a, auto b) { return a < b; });
    check_bit(operation::less_signed, [&](auto a, auto b) { return s(a) < s(b); });
  }
}

TEST(interpreter, extreme_division_at_64_bits_does_not_trap) {
  small_graph s;
  const node_id a = s.read("a", 64), b = s.read("b", 64);
  s.write("q", s.make(operation::divide_signed, 64, {a, b}));
  s.write("r", s.make(operation::remainder_signed, 64, {a, b}));
  interpreter run(s.g);
  run.push(0, std::uint64_t{1} << 63);
  run.push(1, ~std::uint64_t{0});
  ASSERT_EQ(run.step(), outcome::advanced);
  EXPECT_EQ(run.pop_word(run.find_port("q", false)), std::uint64_t{1} << 63);
  EXPECT_EQ(run.pop_word(run.find_port("r", false)), 0u);
}

TEST(interpreter, a_waiting_iteration_has_no_effect_and_names_its_port) {
  // A memory write and a read of it stand before the port read that must wait.
  small_graph s;
  const node_id one = s.constant(1, 1), address = s.constant(2, 1);
  const register_id count = s.add_register("count", 8, 0);
  const node_id value = s.value_of(count), next = s.make(operation::add, 8, {value, s.constant(8, 1)});
  const memory_id m = s.add_memory("ram", 4, 8);
  s.make(operation::memory_write, 0, {address, next, one}, m);
  const node_id seen = s.make(operation::memory_read, 8, {address, one}, m);
  const node_id token = s.read("in", 8);
  s.write("out", s.make(operation::add, 8, {seen, token}));
  s.update(count, next);
  interpreter run(s.g);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(run.step(), outcome::blocked);
  EXPECT_EQ(run.blocked_on(), run.find_port("in", true));
  EXPECT_EQ(run.message(), "iteration 0 waits for a token of port 'in' (small.cpp:7), which has none left");
  EXPECT_EQ(run.register_value(count), 0);
  EXPECT_EQ(run.memory_word(m, 1), 0);
  EXPECT_EQ(run.available(run.find_port("out", false)), 0u);
  run.push(run.find_port("in", true), 40);
  ASSERT_EQ(run.step(), outcome::advanced);
  EXPECT_EQ(run.pop_word(run.find_port("out", false)), 41u);
  EXPECT_EQ(run.memory_word(m, 1), 1);
  EXPECT_EQ(run.blocked_on(), none);
  EXPECT_EQ(run.message(), "");
}

TEST(interpreter, runs_until_a_port_is_empty_or_the_limit_is_reached) {
  small_graph s;
  s.write("out", s.read("in", 8));
  interpreter run(s.g);
  for (std::uint64_t i = 0; i < 10; ++i) run.push(0, i);
  auto p = run.run_until_blocked(4);
  EXPECT_EQ(p.iterations, 4u);
  EXPECT_EQ(p.last, outcome::advanced);
  p = run.run_until_blocked(100);
  EXPECT_EQ(p.iterations, 6u);
  EXPECT_EQ(p.last, outcome::blocked);
  EXPECT_EQ(run.iterations(), 10u);
  for (std::uint64_t i = 0; i < 10; ++i) EXPECT_EQ(run.pop_word(1), i);
  EXPECT_EQ(run.pop_word(1), std::nullopt);
  EXPECT_EQ(run.pop(1), std::nullopt);
}

/// Writes iteration i's token to word i mod 4 and reads the word written `back` iterations ago: 0 is the one written in
/// this iteration, read after it is written; every other is read before.
small_graph ring_of_four(unsigned back, unsigned distance, bool promised) {
  small_graph s;
  const node_id one = s.constant(1, 1);
  const register_id at = s.add_register("at", 2, 0);
  const node_id address = s.value_of(at), token = s.read("in", 8);
  const memory_id m = s.add_memory("ring", 4, 8);
  s.g.memories[m].distance = distance;
  s.g.memories[m].distance_promised = promised;
  const node_id old = s.make(operation::subtract, 2, {address, s.constant(2, back)});
  const auto write = [&] { s.make(operation::memory_write, 0, {address, token, one}, m); };
  if (back == 0) write();
  s.write("out", s.make(operation::memory_read, 8, {old, one}, m));
  if (back != 0) write();
  s.update(at, s.make(operation::add, 2, {address, s.constant(2, 1)}));
  return s;
}

TEST(interpreter, reports_a_broken_distance_promise_with_memory_line_and_address) {
  interpreter keeps(ring_of_four(3, 3, true).g), breaks(ring_of_four(2, 3, true).g);
  for (std::uint64_t i = 0; i < 8; ++i) {
    keeps.push(0, i);
    breaks.push(0, i);
  }
  EXPECT_EQ(keeps.run_until_blocked(100).iterations, 8u);
  const auto p = breaks.run_until_blocked(100);
  EXPECT_EQ(p.last, outcome::broken_promise);
  EXPECT_EQ(p.iterations, 2u);
  EXPECT_EQ(
      breaks.message(),
      "iteration 2: memory 'ring' (small.cpp:7): word 0 is read 2 iterations after it was written, but the source "
      "promises a distance of at least 3");
  EXPECT_EQ(breaks.step(), outcome::broken_promise);
  EXPECT_EQ(breaks.iterations(), 2u);
  breaks.reset();
  breaks.push(0, 1);
  EXPECT_EQ(breaks.step(), outcome::advanced);
}

TEST(interpreter, a_read_within_an_unpromised_distance_is_not_trusted) {
  interpreter run(ring_of_four(1, 2, false).g);
  run.push(0, 5);
  run.push(0, 6);
  EXPECT_EQ(run.run_until_blocked(100).iterations, 2u);
  EXPECT_EQ(run.pop_word(1), 0u);
  EXPECT_EQ(run.pop_word(1), 0xfau);  // not 5
}

TEST(interpreter, a_write_of_the_same_iteration_is_read_but_hides_no_earlier_one_from_the_promise) {
  interpreter keeps(ring_of_four(0, 4, true).g), breaks(ring_of_four(0, 5, true).g);
  interpreter unpromised(ring_of_four(0, 5, false).g);
  for (std::uint64_t i = 0; i < 8; ++i) {
    keeps.push(0, 10 + i);
    breaks.push(0, 10 + i);
    unpromised.push(0, 10 + i);
  }
  EXPECT_EQ(keeps.run_until_blocked(100).iterations, 8u);
  EXPECT_EQ(unpromised.run_until_blocked(100).iterations, 8u);
  for (std::uint64_t i = 0; i < 8; ++i) {
    EXPECT_EQ(keeps.pop_word(1), 10 + i);
    EXPECT_EQ(unpromised.pop_word(1), 10 + i);
  }
  EXPECT_EQ(breaks.run_until_blocked(100).iterations, 4u);
  EXPECT_EQ(
      breaks.message(),
      "iteration 4: memory 'ring' (small.cpp:7): word 0 is read 4 iterations after it was written, but the source "
      "promises a distance of at least 5");
  // Nothing has changed, also in the memory: the word that was written first is the earlier one again.
  EXPECT_EQ(breaks.memory_word(0, 0), 10u);
}

TEST(interpreter, a_patient_register_updated_in_an_impatient_iteration_breaks_a_promise) {
  small_graph s;
  const node_id token = s.read("in", 1);
  const register_id r = s.add_register("ratio", 8, 0);
  s.g.registers[r].patient = true;
  s.update(r, s.constant(8, 3), s.constant(1, 1));
  s.g.patient = token;
  interpreter run(s.g);
  run.push(0, 1);
  run.push(0, 0);
  EXPECT_EQ(run.step(), outcome::advanced);
  EXPECT_EQ(run.step(), outcome::broken_promise);
  EXPECT_EQ(
      run.message(),
      "iteration 1: patient register 'ratio' (small.cpp:7) is updated in an iteration that is not marked patient");
  EXPECT_EQ(run.available(0), 1u);
}

TEST(interpreter, refuses_wrong_tokens_ports_and_graphs) {
  small_graph s;
  s.write("out", s.read("in", 65));
  interpreter run(s.g);
  EXPECT_THROW(run.push(0, APInt(64, 1)), std::invalid_argument);
  EXPECT_THROW(run.push(1, APInt(65, 1)), std::invalid_argument);
  EXPECT_THROW(run.push(9, 1), std::invalid_argument);
  EXPECT_THROW(run.pop(0), std::invalid_argument);
  EXPECT_THROW(run.pop_word(1), std::invalid_argument);
  EXPECT_THROW((void)run.available(9), std::invalid_argument);
  EXPECT_THROW((void)run.register_value(0), std::out_of_range);
  EXPECT_THROW((void)run.memory_word(0, 0), std::out_of_range);
  EXPECT_EQ(run.find_port("in", false), none);
  run.push(0, 7);  // a short token of a wide port is zero extended
  ASSERT_EQ(run.step(), outcome::advanced);
  EXPECT_EQ(run.pop(1), APInt(65, 7));

  small_graph narrow;
  narrow.write("out", narrow.read("in", 8));
  interpreter small(narrow.g);
  EXPECT_THROW(small.push(0, 256), std::invalid_argument);

  narrow.g.nodes.back().operands[0] = 99;
  EXPECT_THROW(interpreter{narrow.g}, std::invalid_argument);
  small_graph large;
  large.add_memory("huge", 1u << 30, 4096);
  EXPECT_THROW(interpreter{large.g}, std::invalid_argument);
}

TEST(interpreter, reset_restores_registers_and_keeps_memories) {
  small_graph s = ring_of_four(1, 1, false);
  interpreter run(s.g);
  for (std::uint64_t i = 0; i < 3; ++i) run.push(0, i + 7);
  ASSERT_EQ(run.run_until_blocked(100).iterations, 3u);
  EXPECT_EQ(run.register_value(0), 3);
  run.push(0, 1);
  run.reset();
  EXPECT_EQ(run.register_value(0), 0);
  EXPECT_EQ(run.memory_word(0, 2), 9);
  EXPECT_EQ(run.available(0), 0u);
  EXPECT_EQ(run.available(1), 0u);
  EXPECT_EQ(run.iterations(), 0u);
}

}  // namespace
}  // namespace epiline::dataflow
