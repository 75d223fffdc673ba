// Schedules: legal, minimal where the minimum is known, independent of luck, and refused with an explanation.

#include "schedule/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>

#include "example_graphs.hpp"
#include "schedule/difference_program.hpp"
#include "schedule/fan_out.hpp"
#include "schedule/problem.hpp"
#include "schedule/reset_gates.hpp"
#include "schedule/result.hpp"

namespace epiline::testing {
namespace {

using schedule::delay_model;
using schedule::make_schedule;
using schedule::settled;

TEST(difference_program, finds_the_minimum) {
  // 0 -> a -> b with b at 5 at least: b is dear and stays early, a is drawn towards b.
  std::vector<std::int64_t> values;
  ASSERT_TRUE(schedule::solve_difference_program({-1, -3, 4}, {{0, 1, 0}, {1, 2, 1}, {0, 2, 5}, {2, 0, -7}}, values));
  EXPECT_EQ(values, (std::vector<std::int64_t>{0, 4, 5}));
}

TEST(difference_program, reports_contradictions_and_unbounded_programs) {
  std::vector<std::int64_t> values;
  EXPECT_FALSE(schedule::solve_difference_program({0, 0}, {{0, 1, 1}, {1, 0, 0}}, values));
  EXPECT_FALSE(schedule::solve_difference_program({1, -1}, {{0, 1, 0}}, values));
}

TEST(delay_model, knows_its_targets) {
  for (const char* name : {"ecp5", "hx8k", "generic"}) EXPECT_EQ(delay_model(name).target(), name);
  try {
    const delay_model unknown("spartan");
    FAIL() << "accepted an unknown target";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("ecp5, hx8k and generic"), std::string::npos) << error.what();
  }
}

TEST(delay_model, prices_wires_at_nothing_and_carries_by_their_length) {
  graph_builder b("delays");
  const auto in = b.stream("in", true, 32);
  const node_id x = b.read(in, b.always());
  const node_id half = b.slice(x, 0, 16);
  const node_id long_sum = b.sum(x, x);
  const node_id short_sum = b.sum(half, half);
  const node_id masked = b.binary(operation::bit_and, x, b.constant(32, 0xff00));
  const node_id joined = b.add(operation::concat, 64, {x, x});
  const node_id moved = b.add(operation::shift_left, 32, {x, b.constant(3, 3)});
  const node_id flags = b.select(b.slice(x, 0, 1), b.constant(9, 0x1f), b.constant(9, 3));
  const node_id turned = b.add(operation::shift_left, 32, {x, b.slice(x, 0, 5)});
  for (const char* target : {"ecp5", "hx8k", "generic"}) {
    const delay_model model(target);
    for (const node_id wire : {half, masked, joined, moved, flags, b.invert(x), b.extend(half, 20)}) {
      EXPECT_EQ(model.delay(b.g, wire), 0) << target << " node " << wire;
      EXPECT_EQ(model.area(b.g, wire), 0) << target << " node " << wire;
    }
    EXPECT_GT(model.delay(b.g, long_sum), model.delay(b.g, short_sum));
    EXPECT_EQ(model.area(b.g, long_sum), 32);
    EXPECT_GT(model.delay(b.g, turned), 0);
  }
  // Two additions of 16 bits, or one and a multiplexer, fit 6 ns on an ECP5: what kernels may rely on.
  const delay_model ecp5("ecp5");
  const double budget = 6.0 - ecp5.parameters().launch - ecp5.parameters().capture;
  EXPECT_LT(2 * ecp5.delay(b.g, short_sum), budget);
}

TEST(delay_model, makes_results_with_many_readers_slow) {
  const delay_model model("ecp5");
  const graph few = make_adder_pipeline();
  const graph many = make_many_readers(80);
  const auto slowest = [&](const graph& g) {
    const schedule::spread spread = schedule::find_spread(g, model);
    return *std::max_element(spread.after.begin(), spread.after.end()) +
           *std::max_element(spread.before.begin(), spread.before.end());
  };
  EXPECT_GT(slowest(many), slowest(few) + 3 * model.parameters().spread_doubling);
  // Wires pass their readers on to what drives them; a slice's part of a value loads the value's bits on average.
  graph_builder b("loads");
  const node_id x = b.read(b.stream("in", true, 8), b.always());
  const node_id low = b.slice(x, 0, 4);
  const node_id doubled = b.sum(low, low);
  const node_id chosen = b.select(b.slice(x, 0, 1), doubled, low);
  b.write(b.stream("out", false, 4), b.always(), chosen);
  double loads_of_x = 0;
  for (const schedule::load& l : schedule::find_loads(b.g, model)) {
    if (l.value == x) loads_of_x += l.inputs;
  }
  // The slice drives the sum twice and the selection once in 4 bits of 8, the condition 4 inputs in one bit of 8.
  EXPECT_DOUBLE_EQ(loads_of_x, 3 * 4 / 8.0 + 4 / 8.0);
}

TEST(make_schedule, leaves_room_for_wires_outside_recurrences) {
  const delay_model model("ecp5");
  const double share = model.parameters().calm_share;
  ASSERT_LT(share, 1);
  const graph g = make_adder_pipeline();
  for (const double period : {6.0, 7.0, 9.0}) {
    EXPECT_LE(make_schedule(g, model, {period, 1}).critical_delay, period * share + 1e-9) << period;
  }
  // A recurrence may take the whole period: with less than that there is no schedule.
  const graph loop = make_accumulator(16, 1);
  const schedule::result s = make_schedule(loop, model, {9, 1});
  const std::vector<schedule::recurrence_delay> loops = schedule::recurrences(loop, model, s);
  ASSERT_FALSE(loops.empty());
  double slowest = 0;
  for (const schedule::recurrence_delay& r : loops) slowest = std::max(slowest, r.delay);
  EXPECT_NO_THROW((void)make_schedule(loop, model, {slowest + 0.01, 1}));
  EXPECT_THROW((void)make_schedule(loop, model, {slowest - 0.05, 1}), schedule::infeasible);
}

TEST(make_schedule, gives_long_ways_a_clock) {
  const delay_model model("ecp5");
  // What is computed with a token waits in a flip-flop first, unless it decides whether the next iteration reads.
  graph_builder b("tokens");
  const auto [more, more_value] = b.state("more", 1, 1);
  const node_id token = b.read(b.stream("in", true, 8), more_value);
  const node_id sum = b.sum(token, token);
  const node_id last = b.compare(operation::equal, token, b.constant(8, 0));
  b.set(more, b.invert(last), b.always());
  // The words of many block RAMs, too.
  const auto address = b.extend(b.slice(token, 0, 8), 10);
  const auto few = b.memory("few", 1024, 18, 1), many = b.memory("many", 1024, 360, 1);
  const node_id of_few = b.load(few, address, b.always()), of_many = b.load(many, address, b.always());
  b.store(few, address, b.extend(sum, 18), b.always());
  b.store(many, address, b.extend(sum, 360), b.always());
  const node_id few_word = b.invert(b.sum(of_few, of_few)), many_bits = b.binary(operation::bit_xor, of_many, of_many);
  b.write(b.stream("out", false, 378), b.always(), b.add(operation::concat, 378, {few_word, many_bits}));
  const schedule::result s = make_schedule(b.g, model, {6, 1});
  EXPECT_EQ(schedule::validate(b.g, model, s), "");
  EXPECT_EQ(s.stage[last], 0);
  EXPECT_GE(s.stage[sum], 1);
  ASSERT_LT(model.blocks(1024, 18), model.parameters().many_blocks);
  ASSERT_GE(model.blocks(1024, 360), model.parameters().many_blocks);
  EXPECT_EQ(s.stage[many_bits], s.stage[of_many] + model.latency(b.g, of_many) + 1);
  EXPECT_EQ(s.available[of_few], s.stage[of_few] + model.latency(b.g, of_few));
}

TEST(delay_model, counts_block_rams_like_yosys) {
  const delay_model model("ecp5");
  EXPECT_EQ(model.blocks(1024, 336), 19u);
  EXPECT_EQ(model.blocks(1024, 1200), 67u);
  EXPECT_EQ(model.blocks(512, 36), 1u);
  EXPECT_EQ(model.blocks(16384, 1), 1u);
  EXPECT_EQ(model.blocks(16385, 1), 2u);
}

TEST(delay_model, puts_wide_memories_of_few_words_into_block_ram) {
  const delay_model ecp5("ecp5");
  dataflow::memory m;
  m.words = 32;
  m.width = 8;
  EXPECT_EQ(ecp5.storage(m), schedule::storage_kind::distributed);
  EXPECT_EQ(delay_model("hx8k").storage(m), schedule::storage_kind::block);  // has no LUT RAM
  m.width = 128;  // 384 LUTs of RAM and 128 that choose between its halves, or 4 block RAMs
  EXPECT_EQ(ecp5.distributed_area(m.words, m.width), 512.0);
  EXPECT_EQ(ecp5.storage(m), schedule::storage_kind::block);
  m.width = 1280;
  EXPECT_EQ(ecp5.storage(m), schedule::storage_kind::block);
  EXPECT_GT(ecp5.distributed_area(m.words, m.width), 100.0 * ecp5.blocks(m.words, m.width));
  m.words = 16;
  EXPECT_EQ(ecp5.storage(m), schedule::storage_kind::distributed);
  m.words = 65;
  m.width = 1;
  EXPECT_EQ(ecp5.storage(m), schedule::storage_kind::block);
}

TEST(make_schedule, puts_what_fits_into_one_stage) {
  const delay_model model("ecp5");
  const graph g = make_accumulator(16, 1);
  const schedule::result s = make_schedule(g, model, {});
  EXPECT_EQ(schedule::validate(g, model, s), "");
  EXPECT_EQ(s.register_update[0], s.register_stage[0]);
  EXPECT_LE(s.critical_delay, 6.0);
  EXPECT_LE(s.depth, 3);
}

TEST(make_schedule, needs_more_stages_for_a_shorter_period) {
  const delay_model model("ecp5");
  const graph g = make_adder_pipeline();
  int depth = 1;
  for (const double period : {40.0, 8.0, 5.0}) {
    const schedule::result s = make_schedule(g, model, {.period = period});
    EXPECT_EQ(schedule::validate(g, model, s), "");
    EXPECT_GT(s.depth, depth) << period;
    EXPECT_LE(s.critical_delay, period + 1e-6);
    depth = s.depth;
  }
}

TEST(make_schedule, delays_the_narrow_side) {
  // Two additions in a row do not fit; the 4-bit result may wait, its 32-bit inputs may not.
  graph_builder b("narrow");
  const auto in = b.stream("in", true, 64);
  const auto out = b.stream("out", false, 32);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const node_id low = b.slice(x, 0, 32);
  const node_id high = b.slice(x, 32, 32);
  const node_id narrow = b.slice(b.sum(low, high), 28, 4);
  node_id slow = b.sum(low, low);
  for (unsigned i = 0; i < 7; ++i) slow = b.sum(slow, slow);
  b.write(out, one, b.sum(slow, b.extend(narrow, 32)));
  const delay_model model("ecp5");
  const schedule::result s = make_schedule(b.g, model, {.period = 4.2});
  ASSERT_EQ(schedule::validate(b.g, model, s), "");
  // Eight sums in eight stages: 32 bits between each two, 4 bits beside them from the second on, and the token before.
  const std::uint64_t earliest = static_cast<std::uint64_t>(s.depth) * (32 + 4) + 64;
  EXPECT_LT(s.pipeline_bits, earliest);
  EXPECT_GT(s.pipeline_bits, static_cast<std::uint64_t>(s.depth - 3) * 32);
}

TEST(make_schedule, is_never_worse_than_random_ones) {
  const delay_model model("ecp5");
  for (const graph& g : {make_adder_pipeline(), make_filter(), make_long_wait(10), make_calls(),
                         make_conditional_streams(), make_histogram(4), make_block_matcher(4)}) {
    const schedule::result best = make_schedule(g, model, {});
    ASSERT_EQ(schedule::validate(g, model, best), "") << g.name;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const schedule::result other = schedule::make_random_schedule(g, model, {}, seed);
      ASSERT_EQ(schedule::validate(g, model, other), "") << g.name << " seed " << seed;
      // A stage more or less has a price of its own: at most 4 bits each.
      EXPECT_LE(best.pipeline_bits + 4 * best.depth, other.pipeline_bits + 4 * other.depth) << g.name;
    }
  }
}

TEST(make_schedule, keeps_memories_within_their_distance) {
  const delay_model model("ecp5");
  const graph g = make_histogram(4);
  const schedule::result s = make_schedule(g, model, {});
  ASSERT_EQ(schedule::validate(g, model, s), "");
  int read = -1;
  int write = -1;
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (g.nodes[id].kind == operation::memory_read) read = s.stage[id];
    if (g.nodes[id].kind == operation::memory_write) write = s.stage[id];
  }
  EXPECT_GE(write, read + 2);  // the block RAM's latency
  EXPECT_LE(write, read + 3);  // the distance
}

/// A sum of stage 1, let through or not in stage 4, where an adder takes it: the stage of the gate after the move.
int stage_of_gate(int condition_stage, bool sum_has_another_use) {
  graph_builder b("gates");
  const auto in = b.stream("in", true, 16), out = b.stream("out", false, 16);
  const node_id x = b.read(in, b.always());
  const node_id value = b.sum(x, x);
  const node_id condition = b.compare(operation::equal, x, b.constant(16, 5));
  const node_id gate = b.select(condition, value, b.constant(16, 0));
  const node_id total = b.sum(gate, sum_has_another_use ? value : x);
  b.write(out, b.always(), total);
  const delay_model model("ecp5");
  const schedule::problem p(b.g, model);
  std::vector<int> stage(p.count(), 4);
  stage[schedule::problem::of_node(x)] = 0;
  stage[schedule::problem::of_node(value)] = 1;
  stage[schedule::problem::of_node(condition)] = condition_stage;
  const schedule::options wanted{.period = 6};
  move_gates_to_flip_flops(b.g, model, p, make_result(b.g, model, wanted, p, stage), stage);
  EXPECT_EQ(validate(b.g, model, make_result(b.g, model, wanted, p, stage)), "");
  return stage[schedule::problem::of_node(gate)];
}

TEST(move_gates_to_flip_flops, makes_a_gate_the_reset_of_the_flip_flops_before_an_adder) {
  EXPECT_EQ(stage_of_gate(1, false), 3);
}

TEST(move_gates_to_flip_flops, leaves_a_gate_whose_condition_would_have_no_copies_or_whose_value_is_needed_itself) {
  EXPECT_EQ(stage_of_gate(2, false), 4);
  EXPECT_EQ(stage_of_gate(1, true), 4);
}

TEST(make_schedule, lets_settled_values_be) {
  const delay_model model("ecp5");
  const graph g = make_calls();
  const schedule::result s = make_schedule(g, model, {});
  ASSERT_EQ(schedule::validate(g, model, s), "");
  EXPECT_EQ(s.register_stage[1], settled);
  EXPECT_NE(s.register_stage[0], settled);
  EXPECT_GT(s.hold, s.register_update[1]);
  EXPECT_EQ(s.hold, s.commit + 1);  // one level of settled registers: the bias
}

TEST(make_schedule, is_the_same_every_time) {
  const delay_model model("ecp5");
  const graph g = make_block_matcher(8);
  const schedule::result a = make_schedule(g, model, {});
  const schedule::result b = make_schedule(g, model, {});
  EXPECT_EQ(a.stage, b.stage);
  EXPECT_EQ(a.register_stage, b.register_stage);
  const schedule::result random = schedule::make_random_schedule(g, model, {}, 5);
  EXPECT_EQ(random.stage, schedule::make_random_schedule(g, model, {}, 5).stage);
  EXPECT_NE(random.stage, schedule::make_random_schedule(g, model, {}, 6).stage);
}

TEST(make_schedule, takes_linear_time) {
  const delay_model model("ecp5");
  const auto seconds = [&](unsigned levels) {
    double best = std::numeric_limits<double>::max();
    const graph g = make_block_matcher(levels);
    for (int trial = 0; trial < 3; ++trial) {
      const std::clock_t start = std::clock();  // processor time: other programs run beside this test
      const schedule::result s = make_schedule(g, model, {});
      best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      EXPECT_EQ(schedule::validate(g, model, s), "");
    }
    return best;
  };
  const double small = seconds(40);
  const double large = seconds(160);  // 16,000 nodes
  EXPECT_LT(large, 4.0);
  // Four times the size: network simplex grows a little faster than linearly, and caches are shared.
  EXPECT_LT(large, 16 * small + 0.1);
}

TEST(make_schedule, refuses_senseless_options) {
  const delay_model model("ecp5");
  const graph g = make_counter();
  EXPECT_THROW((void)make_schedule(g, model, {.period = 0}), std::invalid_argument);
  EXPECT_THROW((void)make_schedule(g, model, {.period = -1}), std::invalid_argument);
  EXPECT_THROW((void)make_schedule(g, model, {.period = std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW((void)make_schedule(g, model, {.period = 6, .initiation_interval = 0}), std::invalid_argument);
}

/// The refusal of a schedule; fails the test when there is none.
template <class Check>
void expect_infeasible(const graph& g, const schedule::options& wanted, Check check) {
  const delay_model model("ecp5");
  try {
    (void)make_schedule(g, model, wanted);
    FAIL() << g.name << ": found a schedule";
  } catch (const schedule::infeasible& error) {
    check(error, std::string(error.what()));
    // What it offers must be true, and hardly less must be wrong.
    if (error.smallest_period() > 0) {
      schedule::options slower = wanted;
      slower.period = error.smallest_period();
      EXPECT_EQ(schedule::validate(g, model, make_schedule(g, model, slower)), "");
      slower.period -= 0.02;
      EXPECT_THROW((void)make_schedule(g, model, slower), schedule::infeasible);
    }
    if (error.smallest_interval() > 0) {
      schedule::options rarer = wanted;
      rarer.initiation_interval = error.smallest_interval();
      EXPECT_EQ(schedule::validate(g, model, make_schedule(g, model, rarer)), "");
      rarer.initiation_interval -= 1;
      EXPECT_THROW((void)make_schedule(g, model, rarer), schedule::infeasible);
    }
  }
}

TEST(infeasible, names_the_recurrence) {
  const graph g = make_accumulator(16, 3);
  expect_infeasible(g, {.period = 6}, [](const schedule::infeasible& error, const std::string& text) {
    EXPECT_NE(text.find("kernel.cpp:44: a recurrence through 'running_sum' cannot close in 1 clock of 6.00 ns"),
              std::string::npos)
        << text;
    for (const char* line : {"kernel.cpp:44: add, 16 bits", "kernel.cpp:45: add", "kernel.cpp:46: add"}) {
      EXPECT_NE(text.find(line), std::string::npos) << text;
    }
    ASSERT_EQ(error.chain().size(), 3u);
    EXPECT_EQ(error.where().line, 44u);
    EXPECT_NEAR(error.required_period(), 1.32 + 3 * 2.15, 0.02);
    EXPECT_NEAR(error.smallest_period(), error.required_period(), 0.011);
    EXPECT_EQ(error.smallest_interval(), 2);
  });
}

TEST(infeasible, names_the_memory) {
  expect_infeasible(make_histogram(1), {.period = 6}, [](const schedule::infeasible& error, const std::string& text) {
    EXPECT_NE(text.find("memory 'bins'"), std::string::npos) << text;
    EXPECT_NE(text.find("DEPENDENCE"), std::string::npos) << text;
    EXPECT_NE(text.find("no period helps"), std::string::npos) << text;
    EXPECT_EQ(error.smallest_period(), 0);
    EXPECT_EQ(error.smallest_interval(), 3);
  });
}

TEST(infeasible, names_the_read) {
  graph_builder b("late_condition");
  const auto in = b.stream("pixels", true, 32);
  const auto [r, value] = b.state("state", 32, 1);
  b.line = 70;
  node_id next = value;
  for (unsigned i = 0; i < 3; ++i) next = b.sum(next, value);
  const node_id condition = b.compare(operation::less_unsigned, next, b.constant(32, 1000));
  b.line = 75;
  b.read(in, condition);
  b.line = 80;
  b.set(r, b.sum(value, b.constant(32, 1)), b.always());
  expect_infeasible(b.g, {.period = 6}, [](const schedule::infeasible& error, const std::string& text) {
    EXPECT_NE(text.find("kernel.cpp:75: the condition of reading 'pixels'"), std::string::npos) << text;
    EXPECT_NE(text.find("kernel.cpp:70: add, 32 bits"), std::string::npos) << text;
    EXPECT_EQ(error.where().line, 75u);
    EXPECT_GT(error.smallest_period(), 10);
  });
}

TEST(infeasible, names_one_slow_operation) {
  graph_builder b("divider");
  const auto in = b.stream("in", true, 32);
  const auto out = b.stream("out", false, 16);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  b.line = 90;
  b.write(out, one, b.binary(operation::divide_unsigned, b.slice(x, 0, 16), b.slice(x, 16, 16)));
  expect_infeasible(b.g, {.period = 6}, [](const schedule::infeasible& error, const std::string& text) {
    EXPECT_NE(text.find("kernel.cpp:90: one operation takes longer than the period"), std::string::npos) << text;
    EXPECT_EQ(error.chain().size(), 1u);
    EXPECT_EQ(error.smallest_interval(), 0);
    EXPECT_GT(error.smallest_period(), 20);
  });
}

TEST(infeasible, names_lines_it_does_not_know) {
  graph g = make_accumulator(16, 3);
  for (dataflow::node& n : g.nodes) n.where = {};
  expect_infeasible(g, {.period = 6}, [](const schedule::infeasible&, const std::string& text) {
    EXPECT_EQ(text.rfind("unknown line: ", 0), 0u) << text;
  });
}

/// Each change breaks one rule of a legal schedule.
TEST(validate, finds_every_kind_of_mistake) {
  const delay_model model("ecp5");
  const auto breaks = [&](const graph& g, auto change, const char* complaint) {
    schedule::result s = make_schedule(g, model, {});
    ASSERT_EQ(schedule::validate(g, model, s), "");
    change(s);
    EXPECT_NE(schedule::validate(g, model, s).find(complaint), std::string::npos)
        << complaint << " expected, found: " << schedule::validate(g, model, s);
  };
  const auto find = [](const graph& g, operation kind, unsigned number = 0) {
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      if (g.nodes[id].kind == kind && number-- == 0) return id;
    }
    return dataflow::none;
  };
  const auto move = [](schedule::result& s, node_id id, int by) {
    s.stage[id] += by;
    s.available[id] += by;
  };
  const graph adders = make_adder_pipeline();
  const graph histogram = make_histogram(4);
  const graph calls = make_calls();
  const graph sum = make_accumulator(16, 1);
  breaks(adders, [&](auto& s) { s.stage.pop_back(); }, "another graph");
  breaks(adders, [&](auto& s) { move(s, find(adders, operation::add, 1), -1); }, "before operand");
  breaks(adders, [&](auto& s) { move(s, find(adders, operation::read), 1); }, "a read outside stage 0");
  breaks(adders, [&](auto& s) { s.available[find(adders, operation::add, 0)] += 1; }, "wrong latency");
  breaks(adders, [&](auto& s) { move(s, find(adders, operation::write), 99); }, "outside the pipeline");
  breaks(adders, [&](auto& s) { s.stage[find(adders, operation::read)] = settled; }, "cannot be settled");
  breaks(
      adders,
      [&](auto& s) {
        s.depth = 1;
        for (node_id id = 0; id < adders.nodes.size(); ++id) {
          if (s.stage[id] > 0) s.stage[id] = s.available[id] = 0;
        }
      },
      "its chain takes");
  breaks(sum, [&](auto& s) { ++s.register_update[0], ++s.depth; }, "recurrence does not close");
  breaks(sum, [&](auto& s) { ++s.register_stage[0]; }, "not in its register's stage");
  breaks(sum, [&](auto& s) { s.register_update[0] = -1; }, "updated before its input");
  breaks(
      histogram,
      [&](auto& s) {
        s.depth += 9;
        move(s, find(histogram, operation::memory_write), 9);
      },
      "too late for a later iteration's read");
  breaks(calls, [&](auto& s) { s.commit = 0; }, "committed before");
  breaks(calls, [&](auto& s) { --s.hold; }, "before settled values are right");
  breaks(calls, [&](auto& s) { s.settle_level.assign(s.settle_level.size(), 0); }, "settles too early");
  breaks(calls, [&](auto& s) { s.stage[find(calls, operation::register_value, 0)] = settled; }, "not patient");
}

}  // namespace
}  // namespace epiline::testing
