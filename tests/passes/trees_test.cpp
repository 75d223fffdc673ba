// Balanced trees and reduced strength.
#include "passes/balance_trees.hpp"
#include "passes/cycles.hpp"
#include "passes/narrow_widths.hpp"
#include "passes/pass_fixture.hpp"
#include "passes/reduce_strength.hpp"
#include "passes/remove_dead.hpp"
#include "passes/simplify.hpp"

namespace epiline::passes {
namespace {

using namespace testing;
using op = operation;

/// Longest chain of operations that are more than wires.
unsigned depth_of(const graph& g) {
  std::vector<unsigned> depth(g.nodes.size(), 0);
  unsigned most = 0;
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    for (const node_id operand : g.nodes[id].operands) depth[id] = std::max(depth[id], depth[operand]);
    switch (g.nodes[id].kind) {
      case op::add:
      case op::subtract:
      case op::bit_and:
      case op::bit_or:
      case op::bit_xor:
      case op::select:
      case op::less_unsigned:
      case op::less_signed:
      case op::multiply:
        ++depth[id];
        break;
      default:
        break;
    }
    most = std::max(most, depth[id]);
  }
  return most;
}

/// The pass leaves what it replaced behind.
void balance(graph& g) {
  balance_trees(g);
  remove_dead(g);
}

std::vector<node_id> inputs(small_graph& s, unsigned count, unsigned width) {
  std::vector<node_id> ids;
  for (unsigned i = 0; i < count; ++i) ids.push_back(s.read("in" + std::to_string(i), width));
  return ids;
}

TEST(balance_trees, chains_of_every_family_get_logarithmic_depth) {
  for (const op kind : {op::add, op::bit_and, op::bit_or, op::bit_xor}) {
    small_graph s;
    const auto in = inputs(s, 16, 10);
    node_id all = in[0];
    for (unsigned i = 1; i < 16; ++i) all = s.make(kind, 10, {all, in[i]});
    s.write("out", all);
    EXPECT_EQ(depth_of(s.g), 15u);
    EXPECT_EQ(depth_of(run(s.g, balance)), 4u) << name_of(kind);
  }
}

TEST(balance_trees, chains_of_minima_and_maxima) {
  for (const op less : {op::less_unsigned, op::less_signed})
    for (const bool minimum : {false, true}) {
      small_graph s;
      const auto in = inputs(s, 8, 10);
      node_id best = in[0];
      for (unsigned i = 1; i < 8; ++i) {
        const node_id c = s.make(less, 1, {best, in[i]});
        best = s.make(op::select, 10, minimum ? std::vector{c, best, in[i]} : std::vector{c, in[i], best});
      }
      s.write("out", best);
      EXPECT_EQ(depth_of(s.g), 14u);
      graph after = run(s.g, balance_trees);
      simplify(after);
      EXPECT_EQ(depth_of(after), 6u);
    }
}

TEST(balance_trees, sums_that_grow_are_balanced_and_stay_narrow) {
  small_graph s;  // the running total of seven 10-bit values needs 11, 12, 12, 13 bits ...
  const auto in = inputs(s, 7, 10);
  node_id sum = in[0];
  const unsigned widths[] = {11, 12, 12, 13, 13, 13};
  for (unsigned i = 1; i < 7; ++i) {
    const unsigned width = widths[i - 1];
    if (s.g.nodes[sum].width < width) sum = s.make(op::extend_zero, width, {sum});
    sum = s.make(op::add, width, {sum, s.make(op::extend_zero, width, {in[i]})});
  }
  s.write("out", sum);
  graph after = run(s.g, balance_trees);
  narrow_widths(after);
  simplify(after);
  EXPECT_EQ(depth_of(after), 3u);
  unsigned bits = 0;
  for (const node& n : after.nodes) bits += n.kind == op::add ? n.width : 0;
  EXPECT_LE(bits, 11u * 3 + 12u * 2 + 13u);
}

TEST(balance_trees, a_sum_that_may_wrap_before_its_extension_is_not_taken_apart) {
  small_graph s;
  const auto in = inputs(s, 4, 8);
  const node_id wrapped = s.make(op::add, 8, {s.make(op::add, 8, {in[0], in[1]}), in[2]});
  s.write("out", s.make(op::add, 9, {s.make(op::extend_zero, 9, {wrapped}), s.make(op::extend_zero, 9, {in[3]})}));
  run(s.g, balance_trees);  // checks that the output is the same
}

TEST(balance_trees, differences_count_as_sums) {
  small_graph s;
  const auto in = inputs(s, 8, 12);
  node_id sum = in[0];
  for (unsigned i = 1; i < 8; ++i) sum = s.make(i % 3 == 0 ? op::add : op::subtract, 12, {sum, in[i]});
  s.write("out", sum);
  EXPECT_EQ(depth_of(run(s.g, balance)), 3u);
}

TEST(balance_trees, an_accumulator_is_added_last) {
  small_graph s;
  const auto in = inputs(s, 4, 16);
  const auto r = s.add_register("sum", 16, 0);
  node_id sum = s.value_of(r);
  for (const node_id i : in) sum = s.make(op::add, 16, {sum, i});
  s.update(r, sum);
  s.write("out", sum);
  const graph after = run(s.g, balance_trees);
  const node& last = after.nodes[after.registers[r].next];
  ASSERT_EQ(last.kind, op::add);
  EXPECT_TRUE(after.nodes[last.operands[0]].kind == op::register_value ||
              after.nodes[last.operands[1]].kind == op::register_value);
}

TEST(balance_trees, values_used_elsewhere_stay) {
  small_graph s;
  const auto in = inputs(s, 4, 8);
  const node_id first = s.make(op::add, 8, {in[0], in[1]});
  const node_id second = s.make(op::add, 8, {first, in[2]});
  s.write("out", s.make(op::add, 8, {second, in[3]}));
  s.write("part", second);
  const graph after = run(s.g, [](graph& g) {
    balance_trees(g);
    simplify(g);
  });
  EXPECT_EQ(count(after, op::add), 3u);
}

TEST(cycles, are_found_through_registers_and_memories) {
  small_graph s;
  const node_id in = s.read("in", 8), one = s.constant(1, 1);
  const auto r = s.add_register("r", 8, 0);
  const node_id value = s.value_of(r), next = s.make(op::add, 8, {value, in});
  s.update(r, next);
  const auto m = s.add_memory("m", 2, 8);
  const node_id word = s.make(op::memory_read, 8, {one, one}, m), sum = s.make(op::add, 8, {word, next});
  s.make(op::memory_write, 0, {one, sum, one}, m);
  s.write("out", sum);
  const auto cycle = cycles_of(s.g);
  EXPECT_EQ(cycle[in], none);
  EXPECT_NE(cycle[value], none);
  EXPECT_EQ(cycle[value], cycle[next]);
  EXPECT_NE(cycle[word], none);
  EXPECT_EQ(cycle[word], cycle[sum]);
  EXPECT_NE(cycle[word], cycle[value]);
}

graph times(std::uint64_t factor, unsigned max_terms) {
  small_graph s;
  const node_id x = s.make(op::extend_zero, 24, {s.read("x", 16)});
  s.write("out", s.make(op::multiply, 24, {x, s.constant(24, factor)}));
  return run(s.g, [max_terms](graph& g) { reduce_strength(g, max_terms); });
}

TEST(reduce_strength, products_with_constants_become_few_sums) {
  for (std::uint64_t factor = 0; factor < 300; ++factor) EXPECT_EQ(count(times(factor, 10), op::multiply), 0u);
  for (const std::uint64_t factor : {7u, 255u, 0xffff00u, 0xfffffdu}) {  // one difference each
    const graph g = times(factor, 2);
    EXPECT_EQ(count(g, op::add) + count(g, op::subtract) + count(g, op::multiply), 1u) << factor;
  }
  EXPECT_EQ(count(times(0x155555, 4), op::multiply), 1u);  // eleven terms
}

TEST(reduce_strength, divisions_by_every_small_constant_are_exact) {
  for (const op kind : {op::divide_unsigned, op::divide_signed, op::remainder_unsigned, op::remainder_signed})
    for (std::uint64_t divisor = 0; divisor < 256; divisor += divisor < 20 ? 1 : 7) {
      small_graph s;  // a counter goes through all 8-bit values
      const auto r = s.add_register("x", 8, 0);
      const node_id x = s.value_of(r);
      s.update(r, s.make(op::add, 8, {x, s.constant(8, 1)}));
      s.write("out", s.make(kind, 8, {x, s.constant(8, divisor)}));
      const graph after = run(s.g, [](graph& g) { reduce_strength(g); });
      EXPECT_EQ(count(after, kind), 0u);
      EXPECT_EQ(count(after, op::divide_unsigned), 0u) << divisor;
    }
}

}  // namespace
}  // namespace epiline::passes
