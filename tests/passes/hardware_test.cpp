// The passes that make what hardware can do in one go, or takes apart what it cannot.
#include "passes/expand_arithmetic.hpp"
#include "passes/fold_magnitudes.hpp"
#include "passes/pass_fixture.hpp"

namespace epiline::passes {
namespace {

using namespace testing;
using op = operation;

/// negated ? -value : value, as the rules write it.
node_id negate_if(small_graph& s, node_id negated, node_id value) {
  const unsigned width = s.g.nodes[value].width;
  const node_id inverted = s.make(op::bit_xor, width, {value, s.make(op::extend_sign, width, {negated})});
  return s.make(op::add, width, {inverted, s.make(op::extend_zero, width, {negated})});
}

/// |a - b| of two unsigned 8-bit values, in 8 bits.
node_id absolute_difference(small_graph& s, node_id a, node_id b) {
  const node_id difference =
      s.make(op::subtract, 9, {s.make(op::extend_zero, 9, {a}), s.make(op::extend_zero, 9, {b})});
  return negate_if(s, s.make(op::slice, 1, {difference}, none, 8), s.make(op::slice, 8, {difference}));
}

TEST(fold_magnitudes, a_sum_with_an_absolute_difference_is_one_operation) {
  for (const op kind : {op::add, op::subtract}) {
    SCOPED_TRACE(name_of(kind));
    const small_graph s = graph_of([kind](small_graph& g, node_id a, node_id b, node_id, node_id) {
      const node_id more = g.make(op::extend_zero, 12, {absolute_difference(g, a, b)});
      return g.make(kind, 12, {g.make(op::extend_zero, 12, {a}), more});
    });
    const graph after = run(s.g, fold_magnitudes);
    EXPECT_EQ(width_of(after, op::add_or_subtract), 12u);
    EXPECT_EQ(count(after, op::bit_xor) + count(after, op::add), 0u);
  }
}

TEST(fold_magnitudes, of_two_absolute_differences_one_is_made_first) {
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id p, node_id q) {
    const node_id c = g.make(op::concat, 9, {b, p}), d = g.make(op::concat, 9, {q, a});
    const node_id first = absolute_difference(g, a, g.make(op::slice, 8, {c}));
    const node_id second = absolute_difference(g, b, g.make(op::slice, 8, {d}));
    return g.make(op::add, 9, {g.make(op::extend_zero, 9, {first}), g.make(op::extend_zero, 9, {second})});
  });
  const graph after = run(s.g, fold_magnitudes);
  EXPECT_EQ(count(after, op::add_or_subtract), 2u);
  EXPECT_EQ(count(after, op::bit_xor), 0u);
}

TEST(fold_magnitudes, a_value_that_may_wrap_is_not_extended) {
  // -256 as a 9-bit value has a magnitude of 0 in 8 bits, and of 256 in 9.
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id p, node_id) {
    const node_id value = g.make(op::concat, 9, {p, a});
    const node_id size = negate_if(g, g.make(op::slice, 1, {value}, none, 8), g.make(op::slice, 8, {value}));
    return g.make(op::add, 10, {g.make(op::extend_zero, 10, {b}), g.make(op::extend_zero, 10, {size})});
  });
  const graph after = run(s.g, fold_magnitudes);
  EXPECT_EQ(count(after, op::add), 1u);
  EXPECT_EQ(width_of(after, op::add_or_subtract), 8u);
}

TEST(fold_magnitudes, a_magnitude_with_another_use_is_made_once) {
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id, node_id) {
    const node_id size = absolute_difference(g, a, b);
    return g.make(op::concat, 16, {g.make(op::add, 8, {a, size}), size});
  });
  const graph after = run(s.g, fold_magnitudes);
  EXPECT_EQ(count(after, op::add_or_subtract), 1u);
  EXPECT_EQ(count(after, op::add), 1u);
}

TEST(fold_magnitudes, a_magnitude_in_two_sums_is_part_of_both) {
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id, node_id) {
    const node_id size = g.make(op::extend_zero, 9, {absolute_difference(g, a, b)});
    const node_id x = g.make(op::extend_zero, 9, {a}), y = g.make(op::extend_zero, 9, {b});
    return g.make(op::concat, 18, {g.make(op::add, 9, {x, size}), g.make(op::subtract, 9, {y, size})});
  });
  const graph after = run(s.g, fold_magnitudes);
  EXPECT_EQ(count(after, op::add_or_subtract), 2u);
  EXPECT_EQ(count(after, op::bit_xor) + count(after, op::add), 0u);
}

TEST(expand_arithmetic, a_division_takes_one_subtraction_a_bit) {
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id, node_id) {
    return g.make(op::concat, 16, {g.make(op::divide_unsigned, 8, {a, b}), g.make(op::remainder_unsigned, 8, {a, b})});
  });
  const graph after = run(s.g, [](graph& g) { expand_arithmetic(g, 18); });
  EXPECT_EQ(count(after, op::divide_unsigned) + count(after, op::remainder_unsigned), 0u);
  EXPECT_EQ(count(after, op::subtract), 8u) << "quotient and remainder share the steps";
}

TEST(expand_arithmetic, signed_divisions_keep_the_signs_and_divide_by_zero_like_the_interpreter) {
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id, node_id) {
    // Few divisors, so that 0, 1 and -1 are among them often.
    const node_id divisor = g.make(op::extend_sign, 8, {g.make(op::slice, 2, {b})});
    return g.make(op::concat, 16,
                  {g.make(op::divide_signed, 8, {a, divisor}), g.make(op::remainder_signed, 8, {a, divisor})});
  });
  const graph after = run(s.g, [](graph& g) { expand_arithmetic(g, 18); });
  EXPECT_EQ(count(after, op::divide_signed) + count(after, op::remainder_signed), 0u);
}

TEST(expand_arithmetic, factors_wider_than_a_multiplier_are_multiplied_in_pieces) {
  const small_graph s = graph_of([](small_graph& g, node_id a, node_id b, node_id, node_id) {
    return g.make(op::multiply, 16, {g.make(op::extend_sign, 16, {a}), g.make(op::extend_zero, 16, {b})});
  });
  // 8 bits with sign: pieces of 4 and 4; 8 without: 4, 4 and no sign to spare.
  EXPECT_EQ(count(run(s.g, [](graph& g) { expand_arithmetic(g, 5); }), op::multiply), 4u);
  EXPECT_EQ(count(run(s.g, [](graph& g) { expand_arithmetic(g, 8); }), op::multiply), 2u);
  EXPECT_EQ(count(run(s.g, [](graph& g) { expand_arithmetic(g, 9); }), op::multiply), 1u);
  EXPECT_EQ(count(run(s.g, [](graph& g) { expand_arithmetic(g, 0); }), op::multiply), 1u);
}

}  // namespace
}  // namespace epiline::passes
