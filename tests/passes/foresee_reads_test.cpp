// Whether a token is read becomes a register where the state before tells; what a graph outputs stays the same.
#include "passes/foresee_reads.hpp"

#include "passes/pass_fixture.hpp"

namespace epiline::passes {
namespace {

using namespace testing;
using dataflow::testing::find_difference;

/// Reads in every iteration in which two bits of a counter are equal and its third one is not set; the counter counts
/// where `counts` does.
struct counting : small_graph {
  explicit counting(bool resets = true) {
    const auto bit0 = add_register("bit0", 1, 0);
    const auto bit1 = add_register("bit1", 1, 1);
    const auto bit2 = add_register("bit2", 1, 0);
    g.registers[bit1].resets = resets;
    const node_id zero = value_of(bit0), one = value_of(bit1), two = value_of(bit2);
    const node_id different = make(operation::bit_xor, 1, {zero, one});
    const node_id equal = make(operation::bit_not, 1, {different});
    predicate = make(operation::bit_and, 1, {equal, make(operation::bit_not, 1, {two})});
    const node_id token = read("in", 4, predicate);
    const node_id low = make(operation::slice, 1, {token}, none, 0);
    update(bit0, make(operation::bit_not, 1, {zero}));
    update(bit1, different);
    update(bit2, make(operation::bit_not, 1, {two}), make(operation::bit_or, 1, {low, zero}));
    write("out", token);
  }
  node_id predicate = none;
};

const node& read_of(const graph& g) {
  for (const node& n : g.nodes)
    if (n.kind == operation::read) return n;
  throw std::logic_error("no read");
}

TEST(foresee_reads, makes_a_register_of_the_predicate) {
  const counting s;
  graph g = s.g;
  foresee_reads(g);
  EXPECT_EQ(dataflow::find_violation(g), "");
  const node& predicate = g.nodes[read_of(g).operands[0]];
  ASSERT_EQ(predicate.kind, operation::register_value);
  const dataflow::register_state& needed = g.registers[predicate.object];
  EXPECT_EQ(needed.name, "in_needed");
  EXPECT_EQ(*needed.initial, 0) << "bit0 = 0 and bit1 = 1 are not equal";
  EXPECT_EQ(g.registers.size(), s.g.registers.size() + 1);
  for (std::uint64_t seed = 0; seed < 20; ++seed) EXPECT_EQ(find_difference(s.g, g, seed, 60), "") << "seed " << seed;
}

TEST(foresee_reads, leaves_what_it_cannot_know) {
  const auto is_kept = [](small_graph& s) {
    graph g = s.g;
    foresee_reads(g);
    return g.registers.size() == s.g.registers.size();
  };
  counting not_reset(false);  // after a reset nobody knows bit1, and the predicate hangs on it
  EXPECT_TRUE(is_kept(not_reset));

  small_graph compares;  // an adder or a comparison would lengthen the recurrence
  const auto count = compares.add_register("count", 4, 0);
  compares.write(
      "out",
      compares.read("in", 4, compares.make(operation::equal, 1, {compares.value_of(count), compares.constant(4, 3)})));
  compares.update(count, compares.value_of(count));
  EXPECT_TRUE(is_kept(compares));

  small_graph of_token;  // what another stream says
  const node_id token = of_token.read("choice", 1);
  of_token.write("out", of_token.read("in", 4, of_token.make(operation::bit_not, 1, {token})));
  EXPECT_TRUE(is_kept(of_token));

  small_graph always;
  always.write("out", always.read("in", 4));
  EXPECT_TRUE(is_kept(always));

  small_graph already;
  const auto state = already.add_register("state", 1, 0);
  already.write("out", already.read("in", 4, already.value_of(state)));
  already.update(state, already.make(operation::bit_not, 1, {already.value_of(state)}));
  EXPECT_TRUE(is_kept(already));

  counting patient;  // settled registers change at another time
  patient.g.registers[0].patient = true;
  patient.g.patient = patient.constant(1, 1);
  EXPECT_TRUE(is_kept(patient));
}

TEST(foresee_reads, shares_the_register_of_equal_predicates) {
  counting s;
  s.write("second_out", s.read("second", 4, s.predicate));
  graph g = s.g;
  foresee_reads(g);
  EXPECT_EQ(g.registers.size(), s.g.registers.size() + 1);
  EXPECT_EQ(find_difference(s.g, g, 5, 60), "");
}

}  // namespace
}  // namespace epiline::passes
