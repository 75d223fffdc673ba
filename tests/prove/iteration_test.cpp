// The solver's terms of an iteration against the interpreter, value by value.
#include "prove/iteration.hpp"

#include <gtest/gtest.h>

#include <random>

#include "dataflow/random_graph.hpp"
#include "prove/confirm.hpp"
#include "prove/terms.hpp"

namespace epiline::prove {
namespace {

using namespace dataflow;
using dataflow::testing::random_graph;
using dataflow::testing::random_value;
using llvm::APInt;

/// A term without variables as the number it is.
APInt number(const z3::expr& term) {
  const z3::expr value = term.simplify();
  EXPECT_TRUE(value.is_numeral()) << value;
  return {term.get_sort().bv_size(), value.get_decimal_string(0), 10};
}

bool truth(const z3::expr& term) { return term.simplify().is_true(); }

/// Every operation, every kind of access: from the same start the terms and the interpreter come to the same end.
TEST(iteration, is_what_the_interpreter_does) {
  unsigned advanced = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const graph g = random_graph(seed);
    std::mt19937_64 random(seed);
    concrete_start start;
    for (const register_state& r : g.registers) start.registers.push_back(random_value(random, r.width));
    for (const port& p : g.ports) start.tokens.push_back(random_value(random, p.width));
    start.words.resize(g.memories.size());
    for (memory_id m = 0; m < g.memories.size(); ++m)
      for (unsigned i = 0; i < g.memories[m].words; ++i)
        start.words[m].emplace(i, random_value(random, g.memories[m].width));
    const concrete_end end = run_one_iteration(g, start);
    if (!end.advanced) continue;  // a promise of the source was broken
    ++advanced;

    z3::context solver;
    start_state terms;
    for (const APInt& value : start.registers) terms.registers.push_back(constant_term(solver, value));
    for (const APInt& value : start.tokens) terms.tokens.push_back(constant_term(solver, value));
    terms.recent_writes.resize(g.memories.size());
    terms.word = [&](memory_id m, const z3::expr& index) {
      z3::expr word = solver.bv_val(0, g.memories[m].width);
      for (const auto& [i, value] : start.words[m])
        word = z3::ite(index == constant_term(solver, APInt(index.get_sort().bv_size(), i)),
                       constant_term(solver, value), word);
      return word;
    };
    terms.table_word = [&](std::uint32_t t, const z3::expr& index) {
      const std::uint64_t i = number(index).getZExtValue();
      return constant_term(solver, i < g.tables[t].values.size() ? g.tables[t].values[i] : APInt(g.tables[t].width, 0));
    };
    const iteration one(solver, g, terms);
    for (port_id p = 0; p < g.ports.size(); ++p) {
      EXPECT_EQ(truth(one.accesses(p)), end.accessed[p]) << "seed " << seed << " port " << p;
      if (!g.ports[p].input && end.accessed[p]) {
        EXPECT_EQ(number(one.token(p)), end.tokens[p]) << "seed " << seed << " port " << p;
      }
    }
    for (register_id r = 0; r < g.registers.size(); ++r)
      EXPECT_EQ(number(one.register_after(r)), end.registers[r]) << "seed " << seed << " register " << r;
    for (memory_id m = 0; m < g.memories.size(); ++m)
      for (const auto& [i, value] : end.words[m])
        EXPECT_EQ(number(one.word_after(m, constant_term(solver, APInt(index_width(g.memories[m].words), i)))), value)
            << "seed " << seed << " memory " << m << " word " << i;
  }
  EXPECT_GT(advanced, 50u);
}

TEST(iteration, numbers_the_words_of_a_memory) {
  EXPECT_EQ(index_width(1), 1u);
  EXPECT_EQ(index_width(2), 1u);
  EXPECT_EQ(index_width(3), 2u);
  EXPECT_EQ(index_width(256), 8u);
  EXPECT_EQ(index_width(257), 9u);
  z3::context solver;
  const auto inside = [&](unsigned address, unsigned width, unsigned words) {
    return truth(place_of(solver.bv_val(address, width), words).inside);
  };
  EXPECT_TRUE(inside(2, 2, 3));
  EXPECT_FALSE(inside(3, 2, 3));
  EXPECT_FALSE(inside(4, 40, 4));
  EXPECT_TRUE(inside(3, 2, 4));
}

}  // namespace
}  // namespace epiline::prove
