// Every pass keeps what a graph outputs, keeps it legal and gives the same text every time, on random graphs.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "dataflow/random_graph.hpp"
#include "dataflow/text.hpp"
#include "passes/balance_trees.hpp"
#include "passes/expand_arithmetic.hpp"
#include "passes/fold_magnitudes.hpp"
#include "passes/foresee_reads.hpp"
#include "passes/forward_memories.hpp"
#include "passes/merge_registers.hpp"
#include "passes/narrow_widths.hpp"
#include "passes/pack_memories.hpp"
#include "passes/pipeline.hpp"
#include "passes/reduce_strength.hpp"
#include "passes/remove_dead.hpp"
#include "passes/simplify.hpp"

namespace epiline::passes {
namespace {

using dataflow::graph;
using dataflow::none;
using dataflow::print;
using dataflow::testing::find_difference;
using dataflow::testing::random_graph;

constexpr std::uint64_t seeds = 150;
constexpr unsigned iterations = 40;

void check(const std::function<void(graph&)>& pass) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const graph before = random_graph(seed, {.operations = 20 + static_cast<unsigned>(seed % 80)});
    graph after = before, again = before;
    pass(after);
    pass(again);
    ASSERT_EQ(find_difference(before, after, seed, iterations), "") << "seed " << seed;
    ASSERT_EQ(print(after), print(again)) << "seed " << seed;
  }
}

TEST(equivalence, simplify) { check(simplify); }
TEST(equivalence, remove_dead) { check(remove_dead); }
TEST(equivalence, narrow_widths) { check(narrow_widths); }
TEST(equivalence, merge_registers) { check(merge_registers); }
TEST(equivalence, reduce_strength) {
  check([](graph& g) { reduce_strength(g, 40); });
}
TEST(equivalence, expand_arithmetic) {
  for (const unsigned multiplier_width : {0u, 2u, 5u, 18u})
    check([multiplier_width](graph& g) { expand_arithmetic(g, multiplier_width); });
}
TEST(equivalence, balance_trees) { check(balance_trees); }
TEST(equivalence, fold_magnitudes) { check(fold_magnitudes); }
TEST(equivalence, foresee_reads) { check(foresee_reads); }
TEST(equivalence, order_memory_accesses) { check(order_memory_accesses); }
TEST(equivalence, forward_memories) {
  for (const unsigned writes : {1u, 3u})
    check([writes](graph& g) {
      order_memory_accesses(g);
      forward_memories(g, writes);
    });
}
TEST(equivalence, pack_memories) {
  check([](graph& g) {
    order_memory_accesses(g);
    pack_memories(g);
  });
}
TEST(equivalence, default_pipeline) {
  check([](graph& g) { run_default_pipeline(g); });
}

TEST(pipeline, shrinks_random_graphs) {
  graph_size before, after;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    graph g = random_graph(seed);
    before.nodes += size_of(g).nodes;
    before.register_bits += size_of(g).register_bits;
    const std::vector<pass_report> log = run_default_pipeline(g);
    EXPECT_EQ(log.back().after, size_of(g));
    for (std::size_t i = 1; i < log.size(); ++i) EXPECT_EQ(log[i].before, log[i - 1].after);
    after.nodes += size_of(g).nodes;
    after.register_bits += size_of(g).register_bits;
  }
  EXPECT_LT(after.register_bits, before.register_bits);
}

TEST(pipeline, shows_every_pass_to_an_observer) {
  graph g = random_graph(3);
  graph last = g;
  std::vector<std::string> seen;
  pipeline_options options;
  options.observer = [&](std::string_view pass, const graph& before, const graph& after) {
    seen.emplace_back(pass);
    EXPECT_EQ(print(before), print(last));  // nothing happens in between
    for (const auto& r : after.registers) {
      if (r.origin == dataflow::none) continue;
      ASSERT_LT(r.origin, before.registers.size());
      EXPECT_EQ(r.name, before.registers[r.origin].name);
      EXPECT_LE(r.width, before.registers[r.origin].width);
    }
    for (const auto& m : after.memories) {
      unsigned width = 0;
      for (const dataflow::memory_id origin : m.origins) width += before.memories.at(origin).width;
      EXPECT_LE(m.width, width);
      EXPECT_EQ(m.words, before.memories.at(m.origins.at(0)).words);
    }
    last = after;
  };
  const std::vector<pass_report> log = run_default_pipeline(g, options);
  EXPECT_FALSE(seen.empty());
  EXPECT_EQ(print(last), print(g));
  ASSERT_EQ(seen.size(), log.size());
  for (std::size_t i = 0; i < log.size(); ++i) EXPECT_EQ(seen[i], log[i].pass);
}

TEST(pipeline, reports_as_json) {
  const std::vector<pass_report> reports = {{"simplify", {5, 16, 100}, {3, 8, 0}}};
  EXPECT_EQ(
      to_json(reports).dump(),
      R"([{"after":{"memory_bits":0,"nodes":3,"register_bits":8},"before":{"memory_bits":100,"nodes":5,"register_bits":16},"pass":"simplify"}])");
}

TEST(pipeline, refuses_an_illegal_graph) {
  graph g = random_graph(1);
  g.nodes.back().operands[0] = none;
  EXPECT_THROW(run_default_pipeline(g), std::logic_error);
}

}  // namespace
}  // namespace epiline::passes
