// Each rule of the simplifier does what it is for.
#include "passes/simplify.hpp"

#include "passes/merge_registers.hpp"
#include "passes/pass_fixture.hpp"
#include "passes/remove_dead.hpp"

namespace epiline::passes {
namespace {

using namespace testing;
using op = operation;
using llvm::APInt;

struct rule {
  const char* expected;
  std::function<node_id(small_graph&, node_id, node_id, node_id, node_id)> make;
};

#define EXPRESSION(...)                                                                                  \
  [](small_graph& s, [[maybe_unused]] node_id a, [[maybe_unused]] node_id b, [[maybe_unused]] node_id p, \
     [[maybe_unused]] node_id q) -> node_id { return __VA_ARGS__; }

void check(const std::vector<rule>& rules) {
  for (const rule& r : rules) {
    const graph after = run(graph_of(r.make).g, simplify);
    EXPECT_EQ(output_expression(after), r.expected);
  }
}

TEST(simplify, folds_constants) {
  check({
      {"c.8:44", EXPRESSION(s.make(op::add, 8, {s.constant(8, 200), s.constant(8, 100)}))},
      {"c.8:255", EXPRESSION(s.make(op::divide_unsigned, 8, {s.constant(8, 200), s.constant(8, 0)}))},
      {"c.8:0", EXPRESSION(s.make(op::shift_left, 8, {s.constant(8, 1), s.constant(8, 8)}))},
      {"c.1:1", EXPRESSION(s.make(op::less_signed, 1, {s.constant(8, 255), s.constant(8, 0)}))},
  });
}

TEST(simplify, wires) {
  check({
      {"a", EXPRESSION(s.make(op::slice, 8, {s.make(op::extend_sign, 20, {a})}))},
      {"slice.3@2(a)", EXPRESSION(s.make(op::slice, 3, {s.make(op::slice, 6, {a}, none, 1)}, none, 1))},
      {"c.4:0", EXPRESSION(s.make(op::slice, 4, {s.make(op::extend_zero, 20, {a})}, none, 9))},
      {"extend_sign.4(slice.1@7(a))", EXPRESSION(s.make(op::slice, 4, {s.make(op::extend_sign, 20, {a})}, none, 9))},
      {"extend_zero.6(slice.4@4(a))", EXPRESSION(s.make(op::slice, 6, {s.make(op::extend_zero, 20, {a})}, none, 4))},
      {"slice.3@5(a)", EXPRESSION(s.make(op::slice, 3, {s.make(op::concat, 16, {a, b})}, none, 13))},
      {"concat.4(slice.2@0(a), slice.2@6(b))",
       EXPRESSION(s.make(op::slice, 4, {s.make(op::concat, 16, {a, b})}, none, 6))},
      {"a", EXPRESSION(s.make(op::concat, 8, {s.make(op::slice, 5, {a}, none, 3), s.make(op::slice, 3, {a})}))},
      {"concat.24(a, b, a)", EXPRESSION(s.make(op::concat, 24, {s.make(op::concat, 16, {a, b}), a}))},
      {"extend_zero.20(a)", EXPRESSION(s.make(op::concat, 20, {s.constant(12, 0), a}))},
      {"extend_zero.20(a)", EXPRESSION(s.make(op::extend_zero, 20, {s.make(op::extend_zero, 12, {a})}))},
      {"extend_zero.20(a)", EXPRESSION(s.make(op::extend_sign, 20, {s.make(op::extend_zero, 12, {a})}))},
      {"concat.8(slice.5@0(a), c.3:0)", EXPRESSION(s.make(op::shift_left, 8, {a, s.constant(32, 3)}))},
      {"extend_zero.8(slice.5@3(a))", EXPRESSION(s.make(op::shift_right_logical, 8, {a, s.constant(2, 3)}))},
      {"extend_sign.8(slice.5@3(a))", EXPRESSION(s.make(op::shift_right_arithmetic, 8, {a, s.constant(2, 3)}))},
      {"extend_sign.8(slice.1@7(a))", EXPRESSION(s.make(op::shift_right_arithmetic, 8, {a, s.constant(70, 99)}))},
      {"c.8:0", EXPRESSION(s.make(op::shift_left, 8, {a, s.constant(APInt::getAllOnes(100))}))},
      {"shift_left.8(a, p)", EXPRESSION(s.make(op::shift_left, 8, {a, s.make(op::extend_zero, 8, {p})}))},
  });
}

TEST(simplify, logic) {
  check({
      {"a", EXPRESSION(s.make(op::bit_and, 8, {a, a}))},
      {"c.8:0", EXPRESSION(s.make(op::bit_xor, 8, {a, a}))},
      {"c.8:0", EXPRESSION(s.make(op::bit_and, 8, {a, s.make(op::bit_not, 8, {a})}))},
      {"a", EXPRESSION(s.make(op::bit_not, 8, {s.make(op::bit_not, 8, {a})}))},
      {"bit_not.8(a)", EXPRESSION(s.make(op::bit_xor, 8, {a, s.constant(8, 255)}))},
      {"extend_zero.8(slice.4@0(a))", EXPRESSION(s.make(op::bit_and, 8, {a, s.constant(8, 15)}))},
      {"concat.8(slice.4@4(a), c.4:15)", EXPRESSION(s.make(op::bit_or, 8, {a, s.constant(8, 15)}))},
      {"concat.16(a, b)",
       EXPRESSION(s.make(op::bit_or, 16,
                         {s.make(op::shift_left, 16, {s.make(op::extend_zero, 16, {a}), s.constant(8, 8)}),
                          s.make(op::extend_zero, 16, {b})}))},
      {"extend_zero.16(bit_and.8(a, b))",
       EXPRESSION(s.make(op::bit_and, 16, {s.make(op::extend_zero, 16, {a}), s.make(op::extend_sign, 16, {b})}))},
      {"p", EXPRESSION(s.make(op::select, 1, {p, s.constant(1, 1), s.constant(1, 0)}))},
      {"bit_not.1(p)", EXPRESSION(s.make(op::select, 1, {p, s.constant(1, 0), s.constant(1, 1)}))},
      {"bit_and.1(p, q)", EXPRESSION(s.make(op::select, 1, {p, q, s.constant(1, 0)}))},
      {"bit_or.1(p, q)", EXPRESSION(s.make(op::select, 1, {p, s.constant(1, 1), q}))},
      {"a", EXPRESSION(s.make(op::select, 8, {p, a, a}))},
      {"a", EXPRESSION(s.make(op::select, 8, {s.constant(1, 1), a, b}))},
      {"select.8(p, b, a)", EXPRESSION(s.make(op::select, 8, {s.make(op::bit_not, 1, {p}), a, b}))},
      {"select.8(p, a, b)", EXPRESSION(s.make(op::select, 8, {p, s.make(op::select, 8, {p, a, b}), b}))},
      {"select.8(bit_or.1(p, q), a, b)", EXPRESSION(s.make(op::select, 8, {p, a, s.make(op::select, 8, {q, a, b})}))},
      {"extend_zero.20(select.8(p, a, b))",
       EXPRESSION(s.make(op::select, 20, {p, s.make(op::extend_zero, 20, {a}), s.make(op::extend_zero, 20, {b})}))},
      {"p", EXPRESSION(s.make(op::bit_or, 1, {p, s.make(op::bit_and, 1, {p, q})}))},
      {"bit_or.1(p, q)",
       EXPRESSION(s.make(op::bit_or, 1, {p, s.make(op::bit_and, 1, {s.make(op::bit_not, 1, {p}), q})}))},
  });
}

TEST(simplify, arithmetic) {
  check({
      {"a", EXPRESSION(s.make(op::add, 8, {a, s.constant(8, 0)}))},
      {"add.8(a, c.8:7)",
       EXPRESSION(s.make(op::add, 8, {s.make(op::add, 8, {a, s.constant(8, 3)}), s.constant(8, 4)}))},
      {"a", EXPRESSION(s.make(op::subtract, 8, {s.make(op::add, 8, {a, b}), b}))},
      {"a", EXPRESSION(s.make(op::add, 8, {s.make(op::subtract, 8, {a, b}), b}))},
      {"add.8(a, c.8:251)", EXPRESSION(s.make(op::subtract, 8, {a, s.constant(8, 5)}))},
      {"bit_xor.1(p, q)", EXPRESSION(s.make(op::add, 1, {p, q}))},
      {"concat.8(slice.7@0(a), c.1:0)", EXPRESSION(s.make(op::add, 8, {a, a}))},
      {"concat.8(add.6(slice.6@0(b), slice.6@2(a)), slice.2@0(a))",
       EXPRESSION(s.make(op::add, 8, {a, s.make(op::shift_left, 8, {b, s.constant(4, 2)})}))},
      {"concat.8(slice.5@0(a), c.3:0)", EXPRESSION(s.make(op::multiply, 8, {a, s.constant(8, 8)}))},
      {"c.8:0", EXPRESSION(s.make(op::multiply, 8, {a, s.constant(8, 0)}))},
      {"extend_zero.8(slice.6@2(a))", EXPRESSION(s.make(op::divide_unsigned, 8, {a, s.constant(8, 4)}))},
      {"extend_zero.8(slice.2@0(a))", EXPRESSION(s.make(op::remainder_unsigned, 8, {a, s.constant(8, 4)}))},
      {"c.8:255", EXPRESSION(s.make(op::divide_signed, 8, {a, s.constant(8, 0)}))},
      {"a", EXPRESSION(s.make(op::remainder_signed, 8, {a, s.constant(8, 0)}))},
      {"subtract.8(c.8:0, a)", EXPRESSION(s.make(op::divide_signed, 8, {a, s.constant(8, 255)}))},
  });
}

TEST(simplify, comparisons) {
  check({
      {"equal.1(a, c.8:17)",
       EXPRESSION(s.make(op::equal, 1, {s.make(op::add, 8, {a, s.constant(8, 3)}), s.constant(8, 20)}))},
      {"equal.1(a, b)", EXPRESSION(s.make(op::equal, 1, {s.make(op::subtract, 8, {a, b}), s.constant(8, 0)}))},
      {"c.1:0", EXPRESSION(s.make(op::equal, 1, {s.make(op::extend_zero, 16, {a}), s.constant(16, 300)}))},
      {"equal.1(a, c.8:254)",
       EXPRESSION(s.make(op::equal, 1, {s.make(op::extend_sign, 16, {a}), s.constant(16, 0xfffe)}))},
      {"p", EXPRESSION(s.make(op::equal, 1,
                              {s.make(op::select, 8, {p, s.constant(8, 5), s.constant(8, 9)}), s.constant(8, 5)}))},
      {"less_unsigned.1(a, b)",
       EXPRESSION(
           s.make(op::less_signed, 1, {s.make(op::extend_zero, 16, {a}), s.make(op::extend_zero, 20 - 4, {b})}))},
      {"less_signed.1(a, b)",
       EXPRESSION(s.make(op::less_signed, 1, {s.make(op::extend_sign, 16, {a}), s.make(op::extend_sign, 16, {b})}))},
      {"less_unsigned.1(a, b)",
       EXPRESSION(s.make(op::less_unsigned, 1, {s.make(op::extend_sign, 16, {a}), s.make(op::extend_sign, 16, {b})}))},
      {"slice.1@7(a)", EXPRESSION(s.make(op::less_signed, 1, {a, s.constant(8, 0)}))},
      {"c.1:0", EXPRESSION(s.make(op::less_unsigned, 1, {a, s.constant(8, 0)}))},
      {"equal.1(a, c.8:0)", EXPRESSION(s.make(op::less_unsigned, 1, {a, s.constant(8, 1)}))},
      {"bit_not.1(equal.1(a, c.8:0))", EXPRESSION(s.make(op::less_unsigned, 1, {s.constant(8, 0), a}))},
      {"equal.1(slice.4@4(a), c.4:0)", EXPRESSION(s.make(op::less_unsigned, 1, {a, s.constant(8, 16)}))},
      {"c.1:1", EXPRESSION(s.make(op::less_unsigned, 1, {s.make(op::extend_zero, 16, {a}), s.constant(16, 300)}))},
      {"c.1:1", EXPRESSION(s.make(op::less_signed, 1, {s.make(op::extend_sign, 16, {a}), s.constant(16, 300)}))},
      {"c.1:1", EXPRESSION(s.make(op::less_signed, 1, {s.constant(16, 0xff00), s.make(op::extend_zero, 16, {a})}))},
  });
}

TEST(simplify, equal_expressions_are_one_node) {
  small_graph s = graph_of(EXPRESSION(s.make(
      op::bit_xor, 8, {s.make(op::multiply, 8, {a, b}), s.make(op::bit_not, 8, {s.make(op::multiply, 8, {b, a})})})));
  const graph after = run(s.g, simplify);
  EXPECT_EQ(output_expression(after), "c.8:255");
}

TEST(simplify, reads_of_a_memory_are_one_only_without_a_write_between) {
  small_graph s;
  const node_id one = s.constant(1, 1), address = s.read("a", 3);
  const auto m = s.add_memory("ram", 8, 8);
  const node_id first = s.make(op::memory_read, 8, {address, one}, m);
  const node_id second = s.make(op::memory_read, 8, {address, one}, m);
  s.make(op::memory_write, 0, {address, s.read("d", 8), one}, m);
  const node_id third = s.make(op::memory_read, 8, {address, one}, m);
  s.write("out", s.make(op::concat, 24, {first, second, third}));
  const graph after = run(s.g, simplify);
  EXPECT_EQ(count(after, op::memory_read), 2u);
}

TEST(simplify, registers_that_keep_their_initial_value_and_accesses_that_never_happen_go) {
  small_graph s;
  const auto constant = s.add_register("constant", 8, 7), never = s.add_register("never", 8, 9);
  const auto own = s.add_register("own", 8, 11), unspecified = s.add_register("unspecified", 8, 0);
  s.g.registers[unspecified].initial.reset();
  const node_id in = s.read("in", 8), zero = s.constant(1, 0);
  s.update(constant, s.constant(8, 7));
  s.update(never, in, zero);
  const node_id own_value = s.value_of(own);
  s.update(own, own_value, s.read("p", 1));
  s.update(unspecified, s.constant(8, 0));
  const node_id unread = s.read("unread", 8, zero);
  const auto m = s.add_memory("ram", 4, 8);
  s.make(op::memory_write, 0, {s.constant(2, 1), in, zero}, m);
  const node_id word = s.make(op::memory_read, 8, {s.constant(2, 1), zero}, m);
  s.write("out", s.make(op::concat, 48,
                        {s.value_of(constant), s.value_of(never), own_value, s.value_of(unspecified), unread, word}));
  s.write("silent", in, zero);
  const graph after = run(s.g, simplify);
  EXPECT_EQ(output_expression(after),
            "c.48:" + std::to_string((std::uint64_t{7} << 40) + (std::uint64_t{9} << 32) + (11u << 24)));
  EXPECT_TRUE(after.registers.empty());
  EXPECT_TRUE(after.memories.empty());
  EXPECT_EQ(count(after, op::write), 1u);
  EXPECT_EQ(count(after, op::read), 2u);  // taking a token is an effect, even of one nobody looks at
  EXPECT_EQ(after.ports.size(), s.g.ports.size());
}

TEST(simplify, names_and_lines_survive) {
  small_graph s = graph_of(EXPRESSION(s.make(op::add, 8, {s.make(op::subtract, 8, {a, s.constant(8, 0)}), b})));
  s.g.nodes[s.g.nodes.size() - 3].name = "sum";
  const graph after = run(s.g, simplify);
  const auto found =
      std::find_if(after.nodes.begin(), after.nodes.end(), [](const node& n) { return n.kind == op::add; });
  ASSERT_NE(found, after.nodes.end());
  EXPECT_EQ(found->name, "sum");
  EXPECT_EQ(found->where.line, 7u);
}

TEST(simplify, a_node_without_a_line_is_shown_where_its_operand_is) {
  small_graph s = graph_of(EXPRESSION(s.make(op::add, 8, {a, b})));
  s.g.nodes[s.g.nodes.size() - 3].where = {};
  const graph after = run(s.g, simplify);
  for (const node& n : after.nodes)
    if (n.kind == op::add) EXPECT_EQ(n.where.line, 7u);
}

TEST(simplify, wide_masks_of_many_runs_stay_one_operation) {
  small_graph s;
  APInt mask(4096, 0);
  for (unsigned i = 0; i < 4096; i += 2) mask.setBit(i);
  s.write("out", s.make(op::bit_and, 4096, {s.read("in", 4096), s.constant(mask)}));
  const graph after = run(s.g, simplify);
  EXPECT_EQ(count(after, op::bit_and), 1u);
  EXPECT_LE(after.nodes.size(), s.g.nodes.size());
}

TEST(merge_registers, one_without_an_initial_value_does_not_stand_for_one_that_has_it) {
  small_graph s;
  const node_id in = s.read("in", 8);
  const auto unspecified = s.add_register("unspecified", 8, 0), zero = s.add_register("zero", 8, 0);
  s.g.registers[unspecified].initial.reset();
  s.update(unspecified, in);
  s.update(zero, in);
  s.write("out", s.make(op::concat, 16, {s.value_of(unspecified), s.value_of(zero)}));
  const graph after = run(s.g, [](graph& g) {
    merge_registers(g);
    remove_dead(g);
  });
  EXPECT_EQ(after.registers.size(), 2u);
}

TEST(remove_dead, removes_what_no_output_needs_and_renumbers) {
  small_graph s;
  const node_id in = s.read("in", 8), one = s.constant(1, 1);
  const auto dead = s.add_register("dead", 8, 0), live = s.add_register("live", 8, 0);
  const node_id dead_value = s.value_of(dead);
  s.update(dead, s.make(op::add, 8, {dead_value, in}));  // a cycle nobody reads
  s.update(live, in);
  const auto unread = s.add_memory("unread", 4, 8), used = s.add_memory("used", 4, 8);
  for (const auto m : {unread, used}) s.make(op::memory_write, 0, {s.constant(2, 0), in, one}, m);
  s.g.tables.push_back({"unused", 8, {APInt(8, 1)}, false, {}});
  s.g.tables.push_back({"rom", 8, {APInt(8, 3)}, false, {}});
  const node_id word = s.make(op::memory_read, 8, {s.constant(2, 0), one}, used);
  s.write("out", s.make(op::concat, 24, {word, s.value_of(live), s.make(op::table, 8, {in}, 1)}));
  s.g.registers[dead].patient = true;
  s.g.patient = one;
  const graph after = run(s.g, remove_dead);
  ASSERT_EQ(after.registers.size(), 1u);
  EXPECT_EQ(after.registers[0].name, "live");
  ASSERT_EQ(after.memories.size(), 1u);
  EXPECT_EQ(after.memories[0].name, "used");
  ASSERT_EQ(after.tables.size(), 1u);
  EXPECT_EQ(after.tables[0].name, "rom");
  EXPECT_EQ(count(after, op::add), 0u);
  EXPECT_EQ(after.patient, none);
}

TEST(remove_dead, keeps_the_patient_mark_of_a_live_patient_register) {
  small_graph s;
  const node_id mark = s.read("mark", 1);
  const auto r = s.add_register("ratio", 8, 0);
  s.update(r, s.read("in", 8), mark);
  s.g.registers[r].patient = true;
  s.g.patient = mark;
  s.write("out", s.value_of(r));
  const graph after = run(s.g, simplify);
  ASSERT_NE(after.patient, none);
  EXPECT_EQ(expression(after, after.patient), "mark");
  EXPECT_TRUE(after.registers[0].patient);
}

TEST(merge_registers, equal_counters_become_one) {
  small_graph s;
  const node_id limit = s.read("limit", 8);
  std::vector<node_id> values;
  for (const std::uint64_t start : {0, 0, 0, 1}) {
    const auto r = s.add_register("x" + std::to_string(values.size()), 8, start);
    const node_id x = s.value_of(r), next = s.make(op::add, 8, {x, s.constant(8, 1)});
    s.update(r, s.make(op::select, 8, {s.make(op::equal, 1, {next, limit}), s.constant(8, 0), next}));
    values.push_back(x);
  }
  s.write("out", s.make(op::concat, 32, values));
  const graph after = run(s.g, [](graph& g) {
    merge_registers(g);
    remove_dead(g);
  });
  EXPECT_EQ(after.registers.size(), 2u);  // the fourth starts elsewhere
}

}  // namespace
}  // namespace epiline::passes
