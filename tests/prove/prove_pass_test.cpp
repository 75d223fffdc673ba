// Proofs of right passes, refutations of wrong ones.
#include "prove/prove_pass.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataflow/random_graph.hpp"
#include "dataflow/small_graph.hpp"
#include "dataflow/text.hpp"
#include "passes/foresee_reads.hpp"
#include "passes/pipeline.hpp"
#include "prove/fault.hpp"
#include "prove/session.hpp"

namespace epiline::prove {
namespace {

using namespace dataflow;
using dataflow::testing::random_graph;
using dataflow::testing::random_graph_options;
using dataflow::testing::small_graph;
using op = operation;

/// A graph on which every pass of the pipeline has something to do, with small numbers.
graph busy_graph() {
  small_graph s;
  const node_id a = s.read("a", 6), b = s.read("b", 6), one = s.constant(1, 1);
  const auto wide = [&](node_id id, unsigned width) { return s.make(op::extend_zero, width, {id}); };

  // Two equal counters of 0..9 in 16 bits: to be merged and narrowed.
  std::vector<node_id> counts;
  for (const char* name : {"count", "again"}) {
    const register_id r = s.add_register(name, 16, 0);
    const node_id value = s.value_of(r);
    counts.push_back(value);
    const node_id last = s.make(op::equal, 1, {value, s.constant(16, 9)});
    const node_id next = s.make(op::add, 16, {value, s.constant(16, 1)});
    s.update(r, s.make(op::select, 16, {last, s.constant(16, 0), next}));
  }
  s.write("counts", s.make(op::add, 16, counts));

  // Divisions by a constant and by a variable, a product with a constant.
  s.write("third", s.make(op::divide_unsigned, 6, {a, s.constant(6, 3)}));
  s.write("quotient", s.make(op::divide_signed, 6, {a, b}));
  s.write("five", s.make(op::multiply, 9, {wide(a, 9), s.constant(9, 5)}));

  // A chain of sums, and an absolute difference that is added.
  node_id chain = wide(a, 9);
  for (const char* name : {"c", "d", "e", "f"}) chain = s.make(op::add, 9, {chain, wide(s.read(name, 6), 9)});
  s.write("chain", s.make(op::bit_xor, 9, {chain, s.make(op::extend_sign, 9, {a})}));
  const node_id difference = s.make(op::subtract, 7, {wide(a, 7), wide(b, 7)});
  const node_id negative = s.make(op::slice, 1, {difference}, none, 6);
  const node_id low = s.make(op::slice, 6, {difference});
  const node_id inverted = s.make(op::bit_xor, 6, {low, s.make(op::extend_sign, 6, {negative})});
  const node_id magnitude = s.make(op::add, 6, {inverted, wide(negative, 6)});
  s.write("distance", s.make(op::add, 9, {wide(a, 9), wide(magnitude, 9)}));

  // Two memories with the same addresses, of which words are read, changed and written; one read comes late.
  const node_id address = s.make(op::slice, 3, {b});
  for (const char* name : {"left", "right"}) {
    const memory_id m = s.add_memory(name, 6, 5);
    const node_id word = s.make(op::memory_read, 5, {address, one}, m);
    const node_id changed = s.make(op::add, 5, {word, s.make(op::slice, 5, {a})});
    s.make(op::memory_write, 0, {address, changed, s.make(op::less_unsigned, 1, {a, b})}, m);
    s.write(name, s.make(op::concat, 10, {word, s.make(op::memory_read, 5, {address, one}, m)}));
  }

  // A table of more words than are taken one by one.
  table t;
  t.name = "squares";
  t.width = 8;
  for (unsigned i = 0; i < 300; ++i) t.values.emplace_back(8, (i * i) & 127);
  s.g.tables.push_back(t);
  s.write("square", s.make(op::table, 8, {s.make(op::concat, 9, {s.make(op::slice, 3, {a}), b})}, 0));
  return s.g;
}

using observer = std::function<void(const std::string& pass, const graph& before, const graph& after)>;

void run_pipeline(graph g, const observer& see) {
  passes::pipeline_options options;
  options.forwarded_writes = 2;
  options.multiplier_width = 18;
  options.observer = [&](std::string_view pass, const graph& before, const graph& after) {
    see(std::string(pass), before, after);
  };
  run_default_pipeline(g, options);
}

TEST(prove_pass, proves_every_pass_on_a_graph_with_work_for_all) {
  std::map<std::string, bool> changed;
  run_pipeline(busy_graph(), [&](const std::string& pass, const graph& before, const graph& after) {
    const proof p = prove_pass(pass, before, after, {20});
    EXPECT_EQ(p.result, verdict::proved) << describe(p);
    changed[pass] |= print(before) != print(after);
  });
  EXPECT_EQ(changed.size(), 11u);
  for (const auto& [pass, has_work] : changed)
    if (pass != "place_tables") {  // which marks tables, and changes no value
      EXPECT_TRUE(has_work) << pass;
    }
}

TEST(prove_pass, refutes_nothing_on_random_graphs) {
  unsigned proved = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    run_pipeline(random_graph(seed, {30, true, false}),
                 [&](const std::string& pass, const graph& before, const graph& after) {
                   const proof p = prove_pass(pass, before, after, {0.3});
                   EXPECT_NE(p.result, verdict::refuted) << "seed " << seed << '\n' << describe(p);
                   proved += p.result == verdict::proved;
                   ++all;
                 });
  EXPECT_GT(proved * 10, all * 9);
}

/// One wrong operator after each pass: whatever is refuted differs in the interpreter, too, what is proved does not,
/// and of every pass something is refuted.
TEST(prove_pass, refutes_planted_faults_of_every_pass) {
  std::map<std::string, unsigned> refuted;
  run_pipeline(busy_graph(), [&](const std::string& pass, const graph& before, const graph& after) {
    if (refuted[pass] >= 3) return;
    for (node_id id = 0; id < after.nodes.size(); ++id) {
      graph wrong = after;
      const std::optional<std::string> fault = plant_fault(wrong, static_cast<node_id>((id * 7) % after.nodes.size()));
      if (!fault) continue;
      const proof p = prove_pass(pass, before, wrong, {5});
      if (p.result == verdict::proved) {
        EXPECT_EQ(testing::find_difference(before, wrong, id, 200), "") << pass << ": " << *fault;
      }
      if (p.result != verdict::refuted) continue;
      ASSERT_TRUE(p.difference) << pass;
      // A word that was written a moment ago cannot be set up in the interpreter.
      if (p.difference->confirmed) ++refuted[pass];
      if (refuted[pass] >= 3) return;
    }
  });
  EXPECT_EQ(refuted.size(), 11u);
  for (const auto& [pass, count] : refuted) EXPECT_GE(count, 3u) << pass;
}

/// `before` with a register, and what a wrong pass makes of it.
struct register_case {
  small_graph s;
  register_case() {
    const register_id r = s.add_register("total", 8, 5);
    const node_id sum = s.make(op::add, 8, {s.value_of(r), s.read("x", 8)});
    s.update(r, sum);
    s.write("y", sum);
    s.g.registers[r].origin = r;
  }
};

TEST(prove_pass, names_the_difference_its_line_and_its_start) {
  const register_case c;
  graph wrong = c.s.g;
  ASSERT_EQ(wrong.nodes[wrong.registers[0].next].kind, op::add);
  wrong.nodes[wrong.registers[0].next].kind = op::subtract;
  const proof p = prove_pass("simplify", c.s.g, wrong);
  ASSERT_EQ(p.result, verdict::refuted);
  EXPECT_TRUE(p.difference->confirmed);
  EXPECT_EQ(p.difference->place, "small.cpp:7");
  EXPECT_EQ(p.difference->what, "output 'y': the token");
  ASSERT_EQ(p.difference->start.size(), 2u);
  EXPECT_EQ(p.difference->start[0].first, "register total");
  EXPECT_EQ(p.difference->start[1].first, "token x");
  EXPECT_NE(describe(p).find("simplify: refuted"), std::string::npos);
  EXPECT_NE(describe(p).find("small.cpp:7: output 'y': the token differs; the interpreter says so, too"),
            std::string::npos)
      << describe(p);
}

TEST(prove_pass, refutes_state_that_starts_differently) {
  const register_case c;
  const auto refuted = [&](const std::function<void(graph&)>& fault) {
    graph wrong = c.s.g;
    fault(wrong);
    const proof p = prove_pass("simplify", c.s.g, wrong);
    return p.result == verdict::refuted ? p.difference->what : std::string(name_of(p.result));
  };
  EXPECT_EQ(refuted([](graph&) {}), "proved");
  EXPECT_EQ(refuted([](graph& g) { g.registers[0].initial = llvm::APInt(8, 4); }),
            "register 'total' starts with another value");
  EXPECT_EQ(refuted([](graph& g) { g.registers[0].initial.reset(); }), "register 'total' starts with another value");
  EXPECT_EQ(refuted([](graph& g) { g.registers[0].resets = false; }), "register 'total' starts with another value");
}

TEST(prove_pass, refutes_other_words_of_memories_and_tables) {
  graph g = busy_graph();
  for (memory& m : g.memories) m.initial.assign(m.words, llvm::APInt(m.width, 1));
  for (register_id r = 0; r < g.registers.size(); ++r) g.registers[r].origin = r;
  for (memory_id m = 0; m < g.memories.size(); ++m) g.memories[m].origins = {m};
  g.tables[0].origin = 0;
  graph wrong = g;
  wrong.memories[1].initial[5] = llvm::APInt(5, 3);
  EXPECT_EQ(prove_pass("simplify", g, wrong).result, verdict::refuted);
  wrong = g;
  wrong.memories[0].distance = 2;  // nothing keeps the writes in between
  EXPECT_EQ(prove_pass("forward_memories", g, wrong).result, verdict::not_covered);
  wrong = g;
  wrong.tables[0].values[299] ^= 1;
  EXPECT_EQ(prove_pass("simplify", g, wrong).result, verdict::refuted);
}

/// The words of a large table matter only when the proof fails without them.
TEST(prove_pass, looks_into_large_tables_when_it_must) {
  const auto with_table = [](bool as_table) {
    small_graph s;
    table t;
    t.name = "marks";
    t.width = 4;
    for (unsigned i = 0; i < 512; ++i) t.values.emplace_back(4, i == 77 ? 2 : 0);
    t.origin = 0;
    s.g.tables.push_back(t);
    const node_id address = s.read("address", 9);
    const node_id found = s.make(op::equal, 1, {address, s.constant(9, 77)});
    const node_id computed = s.make(op::concat, 4, {s.constant(2, 0), found, s.constant(1, 0)});
    s.write("word", as_table ? s.make(op::table, 4, {address}, 0) : computed);
    return s.g;
  };
  EXPECT_EQ(prove_pass("simplify", with_table(true), with_table(false)).result, verdict::proved);
}

/// Reads in the iterations in which `phase` is set and `odd` is not, which changes after each with a phase.
struct foreseen_case {
  small_graph s;
  graph before, after;
  explicit foreseen_case(bool resets = true) {
    const register_id phase = s.add_register("phase", 1, 1), odd = s.add_register("odd", 1, 1);
    s.g.registers[odd].resets = resets;
    const node_id p = s.value_of(phase), o = s.value_of(odd);
    const node_id token = s.read("x", 8, s.make(op::bit_and, 1, {p, s.make(op::bit_not, 1, {o})}));
    s.update(phase, s.make(op::bit_not, 1, {p}));
    s.update(odd, s.make(op::bit_not, 1, {o}), p);
    s.write("y", token);
    before = s.g;
    passes::number_objects(before);
    after = before;
    passes::foresee_reads(after);
  }
};

TEST(prove_pass, proves_that_reads_are_foreseen) {
  const foreseen_case c;
  ASSERT_EQ(c.after.registers.size(), 3u);
  const proof p = prove_pass("foresee_reads", c.before, c.after);
  EXPECT_EQ(p.result, verdict::proved) << describe(p);
  EXPECT_EQ(p.relation, "all state that is left is equal; new registers say whether a token is read");
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    graph before = random_graph(seed, {30, true, false});
    passes::number_objects(before);
    graph after = before;
    passes::foresee_reads(after);
    const proof found = prove_pass("foresee_reads", before, after, {2});
    EXPECT_NE(found.result, verdict::refuted) << "seed " << seed << '\n' << describe(found);
  }
}

TEST(prove_pass, refutes_reads_foreseen_wrongly) {
  const foreseen_case c;
  const auto refuted = [&](const std::function<void(graph&)>& fault) {
    graph wrong = c.after;
    fault(wrong);
    const proof p = prove_pass("foresee_reads", c.before, wrong);
    return p.result == verdict::refuted ? p.difference->what : std::string(name_of(p.result));
  };
  const std::string subject = "register 'x_needed': whether a token is read from 'x'";
  EXPECT_EQ(refuted([](graph& g) { g.registers[2].next = g.registers[2].enable; }), subject + " next");
  EXPECT_EQ(refuted([](graph& g) { g.registers[2].initial->flipAllBits(); }), subject + " after a reset");
  EXPECT_EQ(refuted([](graph& g) { g.registers[2].resets = false; }),
            "register 'x_needed' keeps what it foresaw when a reset comes");
  EXPECT_EQ(refuted([](graph& g) { g.registers[2].initial.reset(); }),
            "register 'x_needed' keeps what it foresaw when a reset comes");

  // What a reset leaves as it was may have any value then.
  const foreseen_case kept(false);
  ASSERT_EQ(kept.after.registers.size(), 2u) << "the pass itself leaves this alone";
  graph before = c.before, after = c.after;
  before.registers[1].resets = after.registers[1].resets = false;
  const proof p = prove_pass("foresee_reads", before, after);
  ASSERT_EQ(p.result, verdict::refuted) << describe(p);
  EXPECT_EQ(p.difference->what, subject + " after a reset");
}

TEST(prove_pass, does_not_claim_what_it_cannot_state) {
  const register_case c;
  graph more = c.s.g;
  more.registers.push_back(more.registers[0]);
  more.registers.back().name = "new";
  more.registers.back().origin = none;
  const proof p = prove_pass("some_pass", c.s.g, more);
  EXPECT_EQ(p.result, verdict::not_covered);
  EXPECT_EQ(p.reason, "register 'new' is new");
}

TEST(prove_pass, says_when_the_time_was_too_short) {
  small_graph s;
  const node_id x = s.read("x", 64), y = s.read("y", 64);
  s.write("z", s.make(op::multiply, 64, {x, y}));
  small_graph other;
  const node_id u = other.read("x", 64), v = other.read("y", 64);
  // (x + 1) * y - y
  const node_id more = other.make(op::add, 64, {u, other.constant(64, 1)});
  const node_id masked = other.make(op::bit_xor, 64, {other.make(op::bit_not, 64, {more}), other.constant(64, ~0ull)});
  other.write("z", other.make(op::subtract, 64, {other.make(op::multiply, 64, {masked, v}), v}));
  const proof p = prove_pass("simplify", s.g, other.g, {0.05});
  EXPECT_TRUE(p.result == verdict::timed_out || p.result == verdict::proved) << describe(p);
  if (p.result == verdict::timed_out) {
    EXPECT_EQ(p.unproved, 1u);
  }
  EXPECT_LT(p.seconds, 2);
}

TEST(session, counts_verdicts_by_pass) {
  std::vector<std::string> lines;
  session s({1}, [&](const std::string& line) { lines.push_back(line); });
  const register_case c;
  graph wrong = c.s.g;
  wrong.registers[0].initial = llvm::APInt(8, 4);
  s.pass_ran("top", "simplify", c.s.g, c.s.g);
  EXPECT_FALSE(s.refuted());
  s.pass_ran("top", "simplify", c.s.g, wrong);
  EXPECT_TRUE(s.refuted());
  const nlohmann::json found = s.to_json();
  EXPECT_EQ(found.at("version"), 1);
  EXPECT_EQ(found.at("totals").at("simplify").at("proved"), 1);
  EXPECT_EQ(found.at("totals").at("simplify").at("refuted"), 1);
  EXPECT_EQ(found.at("passes").at(1).at("counterexample").at("what"), "register 'total' starts with another value");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].substr(0, 22), "top: simplify: proved ");
}

}  // namespace
}  // namespace epiline::prove
