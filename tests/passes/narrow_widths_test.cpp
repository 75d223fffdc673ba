// What is known of values holds for every value that occurs; and the pass finds the widths it is for.
#include "passes/narrow_widths.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dataflow/interpreter.hpp"
#include "dataflow/random_graph.hpp"
#include "dataflow/small_graph.hpp"
#include "passes/demanded_bits.hpp"
#include "passes/known_values.hpp"
#include "passes/pass_fixture.hpp"
#include "passes/simplify.hpp"

namespace epiline::passes {
namespace {

using namespace dataflow;
using llvm::APInt;
using op = operation;
using dataflow::testing::small_graph;
using passes::testing::count;
using passes::testing::run;
using passes::testing::width_of;

graph narrowed(const graph& g) {
  return run(g, [](graph& x) {
    for (int i = 0; i < 3; ++i) {
      narrow_widths(x);
      simplify(x);
    }
  });
}

TEST(known_values, contain_every_value_that_occurs) {
  std::uint64_t checked = 0, claims = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const graph g = dataflow::testing::random_graph(seed, {.operations = 20 + static_cast<unsigned>(seed % 80)});
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
        run.push(p, dataflow::testing::random_value(random, g.ports[p].width));
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

/// int arithmetic as C++ promotes it: 32 bits, stored in 16.
TEST(narrow_widths, promoted_sums_of_seven_values_get_thirteen_bits) {
  small_graph s;
  node_id sum = s.constant(32, 0);
  for (int i = 0; i < 7; ++i) {
    const node_id value = s.make(op::extend_zero, 32, {s.read("in" + std::to_string(i), 10)});
    sum = s.make(op::add, 32, {sum, value});
  }
  const node_id stored = s.make(op::slice, 16, {sum});
  const auto r = s.add_register("column", 16, 0);
  s.g.registers[r].initial.reset();
  s.update(r, stored);
  const auto m = s.add_memory("sums", 4, 16);
  const node_id address = s.read("address", 2), one = s.constant(1, 1);
  const node_id word = s.make(op::memory_read, 16, {address, one}, m);
  s.make(op::memory_write, 0, {address, s.value_of(r), one}, m);
  s.write("out", word);
  const graph after = narrowed(s.g);
  EXPECT_EQ(after.registers[0].width, 13u);
  EXPECT_EQ(after.memories[0].width, 13u);
  unsigned widest = 0;
  for (const node& n : after.nodes)
    if (n.kind == op::add) widest = std::max(widest, n.width);
  EXPECT_EQ(widest, 13u);
}

/// x = x + 1 < limit ? x + 1 : 0 in 32 bits.
small_graph counter(op less, node_id (*make_limit)(small_graph&)) {
  small_graph s;
  const node_id limit = make_limit(s);
  const auto r = s.add_register("x", 32, 0);
  const node_id x = s.value_of(r), next = s.make(op::add, 32, {x, s.constant(32, 1)});
  s.update(r, s.make(op::select, 32, {s.make(less, 1, {next, limit}), next, s.constant(32, 0)}));
  s.write("out", x);
  return s;
}

TEST(narrow_widths, a_counter_below_a_limit_needs_the_bits_of_the_limit) {
  for (const op less : {op::less_unsigned, op::less_signed}) {
    const graph constant = narrowed(counter(less, [](small_graph& s) { return s.constant(32, 640); }).g);
    EXPECT_EQ(constant.registers[0].width, 10u);
    const graph input =
        narrowed(counter(less, [](small_graph& s) { return s.make(op::extend_zero, 32, {s.read("w", 11)}); }).g);
    EXPECT_EQ(input.registers[0].width, 11u);
  }
}

TEST(narrow_widths, a_counter_with_an_enable_is_bounded_by_it) {
  small_graph s;
  const auto r = s.add_register("x", 32, 0);
  const node_id x = s.value_of(r);
  s.update(r, s.make(op::add, 32, {x, s.constant(32, 1)}), s.make(op::less_unsigned, 1, {x, s.constant(32, 100)}));
  s.write("out", x);
  EXPECT_EQ(narrowed(s.g).registers[0].width, 7u);
}

TEST(narrow_widths, an_absolute_difference_of_bytes_is_a_byte) {
  small_graph s;
  const node_id a = s.make(op::extend_zero, 32, {s.read("a", 8)}), b = s.make(op::extend_zero, 32, {s.read("b", 8)});
  const node_id difference = s.make(op::subtract, 32, {a, b});
  const node_id negative = s.make(op::less_signed, 1, {difference, s.constant(32, 0)});
  const node_id absolute =
      s.make(op::select, 32, {negative, s.make(op::subtract, 32, {s.constant(32, 0), difference}), difference});
  const auto r = s.add_register("distance", 32, 0);
  s.update(r, absolute);
  s.write("out", s.value_of(r));
  const graph after = narrowed(s.g);
  EXPECT_EQ(after.registers[0].width, 8u);
  for (const node& n : after.nodes)
    if (n.kind == op::subtract) EXPECT_LE(n.width, 9u);
}

TEST(narrow_widths, signed_values_keep_their_sign) {
  small_graph s;
  const node_id a = s.make(op::extend_sign, 64, {s.read("a", 5)}), b = s.make(op::extend_sign, 64, {s.read("b", 5)});
  s.write("product", s.make(op::multiply, 64, {a, b}));
  s.write("less", s.make(op::less_signed, 1, {a, b}));
  s.write("quotient", s.make(op::divide_signed, 64, {a, b}));
  const graph after = narrowed(s.g);
  EXPECT_EQ(width_of(after, op::multiply), 10u);
  EXPECT_EQ(width_of(after, op::divide_signed), 6u);  // -16 / -1
  for (const node& n : after.nodes)
    if (n.kind == op::less_signed) EXPECT_EQ(after.nodes[n.operands[0]].width, 5u);
}

TEST(narrow_widths, bits_nobody_looks_at_go_through_registers_and_memories) {
  small_graph s;
  const auto r = s.add_register("sum", 32, 0);
  const node_id value = s.value_of(r), one = s.constant(1, 1), address = s.read("address", 2);
  s.update(r, s.make(op::add, 32, {value, s.read("in", 32)}));
  const auto m = s.add_memory("ram", 4, 32);
  const node_id word = s.make(op::memory_read, 32, {address, one}, m);
  s.make(op::memory_write, 0, {address, value, one}, m);
  s.write("out", s.make(op::slice, 6, {word}));
  const graph after = narrowed(s.g);
  EXPECT_EQ(after.registers[0].width, 6u);
  EXPECT_EQ(after.memories[0].width, 6u);
  EXPECT_EQ(width_of(after, op::add), 6u);
}

TEST(narrow_widths, a_register_without_an_initial_value_takes_the_width_of_what_is_assigned) {
  small_graph s;
  const auto r = s.add_register("r", 16, 0);
  s.g.registers[r].initial.reset();
  s.update(r, s.make(op::extend_zero, 16, {s.read("in", 5)}));
  s.write("out", s.value_of(r));
  const graph after = narrowed(s.g);
  EXPECT_EQ(after.registers[0].width, 5u);
  EXPECT_FALSE(after.registers[0].initial.has_value());
}

TEST(narrow_widths, division_by_what_may_be_zero_keeps_its_width) {
  small_graph s;
  const node_id a = s.make(op::extend_zero, 32, {s.read("a", 5)}), b = s.make(op::extend_zero, 32, {s.read("b", 5)});
  s.write("out", s.make(op::divide_unsigned, 32, {a, b}));
  EXPECT_EQ(width_of(narrowed(s.g), op::divide_unsigned), 32u);
  small_graph t;
  const node_id c = t.make(op::extend_zero, 32, {t.read("a", 5)}), d = t.make(op::extend_zero, 32, {t.read("b", 5)});
  t.write("out", t.make(op::divide_unsigned, 32, {c, t.make(op::bit_or, 32, {d, t.constant(32, 1)})}));
  EXPECT_EQ(width_of(narrowed(t.g), op::divide_unsigned), 5u);
}

TEST(narrow_widths, tables_lose_bits_that_are_zero_or_unused) {
  small_graph s;
  s.g.tables.push_back({"rom", 16, {APInt(16, 3), APInt(16, 9)}, false, {}});
  s.write("out", s.make(op::table, 16, {s.read("a", 1)}, 0));
  EXPECT_EQ(narrowed(s.g).tables[0].width, 4u);
}

/// The lowest bit that could serve as the sign is one nothing depends on.
TEST(narrow_widths, a_sign_is_taken_from_a_bit_that_is_demanded) {
  small_graph s;
  const node_id a = s.read("a", 1), b = s.read("b", 6), one = s.constant(1, 1), zero = s.constant(1, 0);
  // 11xxxxxx or 00xxxxxx: seven bits with sign, but only bit 7 is looked at.
  const node_id value =
      s.make(op::select, 8, {a, s.make(op::concat, 8, {one, one, b}), s.make(op::concat, 8, {zero, zero, b})});
  const auto r = s.add_register("r", 64, 0);
  s.update(r, s.make(op::extend_sign, 64, {value}));
  s.write("out", s.make(op::slice, 8, {s.value_of(r)}, none, 27));
  EXPECT_EQ(narrowed(s.g).registers[0].width, 7u);

  small_graph t;
  const node_id wide = t.make(op::extend_sign, 64, {t.make(op::bit_and, 8, {t.read("a", 8), t.constant(8, 0x9f)})});
  const node_id shifted = t.make(op::shift_right_arithmetic, 64, {wide, t.read("by", 3)});
  t.write("out", t.make(op::slice, 8, {shifted}, none, 40));
  narrowed(t.g);
}

TEST(narrow_widths, a_narrowed_value_keeps_its_name) {
  small_graph s;
  const node_id a = s.make(op::extend_zero, 32, {s.read("a", 8)}), b = s.make(op::extend_zero, 32, {s.read("b", 8)});
  const node_id sum = s.make(op::add, 32, {a, b});
  s.g.nodes[sum].name = "total";
  s.write("out", s.make(op::slice, 9, {sum}));
  const graph after = narrowed(s.g);
  const auto found =
      std::find_if(after.nodes.begin(), after.nodes.end(), [](const node& n) { return n.kind == op::add; });
  ASSERT_NE(found, after.nodes.end());
  EXPECT_EQ(found->width, 9u);
  EXPECT_EQ(found->name, "total");
}

TEST(demanded_bits, follow_the_operations) {
  small_graph s;
  const node_id a = s.read("a", 16);
  const node_id masked = s.make(op::bit_and, 16, {a, s.constant(16, 0x0ff0)});
  s.write("out", s.make(op::slice, 4, {masked}, none, 2));
  const demanded_bits bits(s.g);
  EXPECT_EQ(bits.of_node(masked), APInt(16, 0x3c));
  EXPECT_EQ(bits.of_node(a), APInt(16, 0x30));
}

TEST(demanded_bits, leave_out_what_follows_from_other_bits) {
  small_graph s;
  const node_id zeros = s.make(op::extend_zero, 16, {s.read("a", 4)});
  const node_id signs = s.make(op::extend_sign, 16, {s.read("b", 4)});
  s.write("zeros", s.make(op::slice, 8, {zeros}, none, 2));
  s.write("signs", s.make(op::slice, 8, {signs}, none, 6));
  const known_values known(s.g);
  const demanded_bits bits(s.g, &known);
  EXPECT_EQ(bits.of_node(zeros), APInt(16, 0xc));  // bits 2 and 3; zeros stand above
  EXPECT_EQ(bits.of_node(signs), APInt(16, 0x8));  // bit 3 stands for bits 6 to 13
}

}  // namespace
}  // namespace epiline::passes
