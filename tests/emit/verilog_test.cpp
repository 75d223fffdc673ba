// Emitted Verilog against the interpreter, under gaps and back-pressure, for hand-made graphs.

#include "emit/verilog.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <regex>

#include "dataflow/random_graph.hpp"
#include "example_graphs.hpp"
#include "rtl_simulation.hpp"

namespace epiline::testing {
namespace {

struct example {
  std::string name;
  graph g;
  double period = 6;
  int interval = 1;
};

std::vector<example> examples() {
  std::vector<example> all;
  const auto add = [&](graph g, double period = 6, int interval = 1) {
    const std::string name = g.name + (interval > 1 ? "_ii" + std::to_string(interval) : "");
    all.push_back({name, std::move(g), period, interval});
  };
  add(make_counter());
  add(make_adder_pipeline());
  add(make_filter());
  add(make_histogram(4));
  add(make_histogram(1), 6, 4);
  add(make_conditional_streams());
  add(make_accumulator(16, 1));
  add(make_accumulator(16, 3), 5, 3);
  add(make_calls());
  add(make_calls(), 6, 3);
  add(make_long_wait(12));
  add(make_long_wait(60));
  all.back().name = "longer_wait";
  add(make_cleared_levels(20));
  add(make_many_waits(5));
  add(make_many_readers(40));
  add(make_small_memory());
  add(make_late_write(20));
  add(make_two_writes(true));
  add(make_two_writes(false));
  add(make_all_operations(), 12);
  return all;
}

class every_example : public ::testing::TestWithParam<example> {};

/// Inputs that keep the promises of the source.
std::vector<token_list> inputs_for(const example& e, std::size_t count) {
  std::vector<token_list> inputs = random_inputs(e.g, count, 11);
  if (e.g.name == "histogram" && e.interval == 1) {
    // Five neighbours differ modulo 5 by construction, so a bin returns after five tokens at the earliest.
    for (std::size_t t = 0; t < count; ++t) inputs[0][t] = llvm::APInt(8, 5 * ((t * 7) % 13) + t % 5);
  }
  return inputs;
}

TEST_P(every_example, is_legal) {
  const example& e = GetParam();
  const schedule::delay_model model("ecp5");
  EXPECT_EQ(dataflow::find_violation(e.g), "");
  const schedule::result s = schedule::make_schedule(e.g, model, {e.period, e.interval});
  EXPECT_EQ(schedule::validate(e.g, model, s), "");
}

TEST_P(every_example, is_clean_verilog) {
  const example& e = GetParam();
  const schedule::delay_model model("ecp5");
  const schedule::result s = schedule::make_schedule(e.g, model, {e.period, e.interval});
  const std::string folder = scratch_folder("lint-" + e.name);
  EXPECT_EQ(lint(e.g, emit::emit_verilog(e.g, model, s), folder), "");
  std::filesystem::remove_all(folder);
}

/// Simulates and compares with what the interpreter gave.
void expect_same(const graph& g, const std::string& verilog, const std::vector<token_list>& inputs,
                 const interpretation& expected, const simulation_options& options) {
  const std::string folder = scratch_folder("run-" + g.name);
  const simulation_result r = simulate(g, verilog, inputs, folder, options);
  ASSERT_EQ(r.problem, "") << folder;
  for (std::size_t i = 0; i < g.ports.size(); ++i) {
    const token_list& wanted = expected.outputs[i];
    ASSERT_GE(r.outputs[i].size(), wanted.size()) << g.ports[i].name << " in " << folder;
    if (expected.complete) {
      ASSERT_EQ(r.outputs[i].size(), wanted.size()) << g.ports[i].name << " in " << folder;
    }
    for (std::size_t t = 0; t < wanted.size(); ++t) {
      ASSERT_EQ(r.outputs[i][t], wanted[t]) << g.ports[i].name << " token " << t << " in " << folder;
    }
  }
  std::filesystem::remove_all(folder);
}

TEST_P(every_example, does_what_the_interpreter_does) {
  const example& e = GetParam();
  const schedule::delay_model model("ecp5");
  const std::vector<token_list> inputs = inputs_for(e, 300);
  const interpretation expected = interpret(e.g, inputs);
  EXPECT_TRUE(expected.complete);
  std::size_t tokens = 0;
  for (const token_list& list : expected.outputs) tokens += list.size();
  EXPECT_GT(tokens, 20u);
  const schedule::options wanted{e.period, e.interval};
  unsigned trial = 0;
  for (const unsigned gaps : {0, 40, 85, 0, 40}) {
    ++trial;
    const schedule::result s = trial <= 3 ? schedule::make_schedule(e.g, model, wanted)
                                          : schedule::make_random_schedule(e.g, model, wanted, trial);
    ASSERT_EQ(schedule::validate(e.g, model, s), "");
    ASSERT_NO_FATAL_FAILURE(
        expect_same(e.g, emit::emit_verilog(e.g, model, s), inputs, expected, {.gap_percent = gaps, .seed = trial}));
  }
}

INSTANTIATE_TEST_SUITE_P(graphs, every_example, ::testing::ValuesIn(examples()),
                         [](const ::testing::TestParamInfo<example>& info) { return info.param.name; });

class random_graphs : public ::testing::TestWithParam<unsigned> {};

TEST_P(random_graphs, do_what_the_interpreter_does) {
  const unsigned seed = GetParam();
  graph g = dataflow::testing::random_graph(seed, {.operations = 60, .memories = false, .divisions = seed % 4 == 0});
  g.name = "random_" + std::to_string(seed);
  for (dataflow::register_state& r : g.registers) {
    if (!r.initial) r.initial = llvm::APInt(r.width, 0);  // unspecified: the interpreter has 0, a simulator x
  }
  const schedule::delay_model model("generic");
  schedule::options wanted{.period = 10};
  schedule::result s;
  try {
    s = schedule::make_random_schedule(g, model, wanted, seed);
  } catch (const schedule::infeasible& error) {
    // Wide operations, long recurrences: what the error offers must work.
    ASSERT_GT(error.smallest_period(), 10) << error.what();
    wanted.period = error.smallest_period();
    s = schedule::make_schedule(g, model, wanted);
  }
  ASSERT_EQ(schedule::validate(g, model, s), "");
  const std::vector<token_list> inputs = random_inputs(g, 60, seed);
  const std::string verilog = emit::emit_verilog(g, model, s);
  const std::string folder = scratch_folder("lint-" + g.name);
  EXPECT_EQ(lint(g, verilog, folder), "");
  std::filesystem::remove_all(folder);
  ASSERT_NO_FATAL_FAILURE(expect_same(g, verilog, inputs, interpret(g, inputs, 200),
                                      {.gap_percent = 30, .seed = seed, .most_clocks = 4000}));
}

INSTANTIATE_TEST_SUITE_P(seeds, random_graphs, ::testing::Range(1u, 13u));

TEST(throughput, is_one_iteration_a_clock_without_stalls) {
  const schedule::delay_model model("ecp5");
  for (const graph& g : {make_counter(), make_long_wait(40), make_histogram(4)}) {
    std::vector<token_list> inputs = random_inputs(g, 500, 1);
    const schedule::result s = schedule::make_schedule(g, model, {});
    const std::string folder = scratch_folder("throughput-" + g.name);
    const simulation_result r = simulate(g, emit::emit_verilog(g, model, s), inputs, folder, {});
    ASSERT_EQ(r.problem, "") << folder;
    // The pipeline is filled once, after a reset has waited once for it to drain.
    EXPECT_LE(r.clocks, 500u + 2 * s.depth + 12) << g.name;
    std::filesystem::remove_all(folder);
  }
}

TEST(emit_verilog, is_the_same_every_time) {
  const schedule::delay_model model("ecp5");
  const graph g = make_block_matcher(6);
  const schedule::result s = schedule::make_schedule(g, model, {});
  const std::string first = emit::emit_verilog(g, model, s);
  EXPECT_EQ(first, emit::emit_verilog(g, model, schedule::make_schedule(g, model, {})));
  EXPECT_NE(first.find("module block_matcher ("), std::string::npos);
}

TEST(emit_verilog, asks_for_no_lut_ram_where_there_is_none) {
  const graph g = make_block_matcher(6);
  const auto text_for = [&g](const char* target) {
    const schedule::delay_model model(target);
    return emit::emit_verilog(g, model, schedule::make_schedule(g, model, {.period = 20}));
  };
  EXPECT_NE(text_for("ecp5").find("\"distributed\""), std::string::npos);  // the output's FIFO, if nothing else
  EXPECT_EQ(text_for("hx8k").find("\"distributed\""), std::string::npos);
}

TEST(emit_verilog, keeps_the_heading_in_comments) {
  const schedule::delay_model model("ecp5");
  const graph g = make_counter();
  const std::string text = emit::emit_verilog(g, model, schedule::make_schedule(g, model, {}),
                                              {.delay_lines = {}, .heading = "first line\nsecond line"});
  EXPECT_NE(text.find("\n// first line\n// second line\n"), std::string::npos) << text;
}

TEST(emit_verilog, names_values_after_the_source) {
  graph g = make_adder_pipeline();
  for (dataflow::node& n : g.nodes) {
    if (n.kind == operation::add) n.name = "column.sum";
  }
  const schedule::delay_model model("ecp5");
  const std::string text = emit::emit_verilog(g, model, schedule::make_schedule(g, model, {}));
  EXPECT_NE(text.find("wire [31:0] column_sum = "), std::string::npos) << text;
  EXPECT_NE(text.find("wire [31:0] column_sum_1 = "), std::string::npos) << text;
  EXPECT_NE(text.find("// kernel.cpp:12"), std::string::npos) << text;
}

TEST(emit_verilog, survives_names_that_verilog_or_the_emitter_use) {
  graph g = make_conditional_streams();
  const char* const awkward[] = {"wire",   "fire", "clk",      "a_token",        "x_s3",
                                 "9lives", "",     "\xc3\xa4", "s_axis_a_tdata", "valid"};
  for (std::size_t i = 0; i < g.nodes.size(); ++i) g.nodes[i].name = awkward[i % std::size(awkward)];
  g.registers[0].name = "reg";
  g.registers[1].name = "running";
  const schedule::delay_model model("ecp5");
  const schedule::result s = schedule::make_schedule(g, model, {});
  const std::string text = emit::emit_verilog(g, model, s);
  const std::string folder = scratch_folder("awkward");
  EXPECT_EQ(lint(g, text, folder), "");
  std::filesystem::remove_all(folder);
  const std::vector<token_list> inputs = random_inputs(g, 50, 3);
  expect_same(g, text, inputs, interpret(g, inputs), {.gap_percent = 20, .seed = 9});
}

TEST(emit_verilog, refuses_ports_it_cannot_name) {
  const schedule::delay_model model("ecp5");
  const auto refuses = [&](auto change, const char* complaint) {
    graph g = make_calls();
    change(g);
    const schedule::result s = schedule::make_schedule(g, model, {});
    try {
      (void)emit::emit_verilog(g, model, s);
      ADD_FAILURE() << "accepted: " << complaint;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(complaint), std::string::npos) << error.what();
    }
  };
  refuses([](graph& g) { g.name = "module"; }, "'module' cannot have that name");
  refuses([](graph& g) { g.name = "two words"; }, "'two words' cannot have that name");
  refuses([](graph& g) { g.name = "../evil"; }, "'../evil' cannot have that name");
  refuses([](graph& g) { g.name = "evil; endmodule\nmodule other"; }, "cannot have that name");
  refuses([](graph& g) { g.name = ""; }, "'' cannot have that name");
  refuses([](graph& g) { g.ports[0].fields[0].signal = "clk"; }, "'clk' has the name of another signal");
  refuses([](graph& g) { g.ports[0].fields[0].signal = "fire"; }, "'fire' has the name of a control signal");
  refuses([](graph& g) { g.ports[0].fields[0].signal = "output"; }, "'output' cannot have that name");
  refuses([](graph& g) { g.ports[0].fields[1].signal = "length"; },
          "kernel.cpp:1: error: port signal 'length' has the name of another signal");
}

TEST(make_plan, puts_long_waits_into_ram) {
  const schedule::delay_model model("ecp5");
  const graph g = make_long_wait(60);
  const schedule::result s = schedule::make_schedule(g, model, {});
  const emit::plan p = emit::make_plan(g, model, s);
  ASSERT_EQ(p.lines.size(), 1u);
  EXPECT_EQ(p.lines[0].storage, schedule::storage_kind::block);
  EXPECT_EQ(p.lines[0].width, 32u);
  EXPECT_GT(p.lines[0].clocks(), 20);
  const emit::plan without = emit::make_plan(g, model, s, {.distributed_clocks = 1000});
  EXPECT_TRUE(without.lines.empty());
  EXPECT_GT(without.copy_bits, p.copy_bits + 20 * 32);
  // A target without LUT RAM keeps short waits in flip-flops.
  const schedule::delay_model small("hx8k");
  const graph shorter = make_long_wait(8);
  for (const emit::delay_line& line :
       emit::make_plan(shorter, small, schedule::make_schedule(shorter, small, {.period = 12})).lines) {
    EXPECT_EQ(line.storage, schedule::storage_kind::block);
  }
}

TEST(make_plan, gives_pointers_of_many_delay_lines_copies) {
  const schedule::delay_model model("ecp5");
  const graph g = make_many_waits(10);
  const emit::plan p = emit::make_plan(g, model, schedule::make_schedule(g, model, {}));
  std::map<std::size_t, unsigned> rams;  // of a LUT RAM's 4 bits, by the copy of the pointers that they hang on
  for (const emit::delay_line& line : p.lines) {
    ASSERT_EQ(line.storage, schedule::storage_kind::distributed);
    rams[line.pointers] += line.width / 4;
  }
  EXPECT_EQ(rams.size(), 3u);
  for (const auto& [copy, count] : rams) EXPECT_LE(count, model.parameters().most_enabled) << copy;
}

TEST(emit_verilog, leaves_registers_that_say_so_as_they_are_at_a_reset) {
  graph g = make_counter();
  ASSERT_FALSE(g.registers.empty());
  g.registers[0].name = "kept";
  g.registers[0].initial = llvm::APInt(g.registers[0].width, 1);
  const schedule::delay_model model("ecp5");
  const auto verilog = [&] { return emit::emit_verilog(g, model, schedule::make_schedule(g, model, {})); };
  const std::string cleared = fmt::format("kept <= {}'d1;", g.registers[0].width);
  const std::string started = fmt::format("kept = {}'d1;", g.registers[0].width);
  EXPECT_THAT(verilog(), ::testing::HasSubstr(cleared));
  EXPECT_THAT(verilog(), ::testing::Not(::testing::HasSubstr(started)));
  g.registers[0].resets = false;
  EXPECT_THAT(verilog(), ::testing::Not(::testing::HasSubstr(cleared)));
  EXPECT_THAT(verilog(), ::testing::HasSubstr(started));
}

TEST(make_plan, gives_many_readers_copies_of_their_flip_flop) {
  const schedule::delay_model model("ecp5");
  const unsigned most = model.parameters().most_readers;
  const graph g = make_many_readers(40);
  const schedule::result s = schedule::make_schedule(g, model, {});
  const emit::plan p = emit::make_plan(g, model, s);
  // The sums, of 16 bits each, hang on the valid bits of their stages.
  std::vector<unsigned> bits_at(p.valid_copies.size(), 0);
  for (std::size_t r = 0; r < g.registers.size(); ++r) bits_at[s.register_update[r]] += g.registers[r].width;
  std::size_t spare = 0;
  for (std::size_t stage = 1; stage < bits_at.size(); ++stage) {
    EXPECT_GE(p.valid_copies[stage].count() * most, bits_at[stage] / 2) << stage;
    EXPECT_LE(p.valid_copies[stage].count(), 1 + bits_at[stage] / 16 + p.valid_copies.size()) << stage;
    spare += p.valid_copies[stage].count() - 1;
  }
  EXPECT_GE(spare, 40 * 16 / most / 2);
  ASSERT_FALSE(p.value_copies.empty());
  for (const auto& [place, copies] : p.value_copies) {
    EXPECT_GT(copies.count(), 1u);
    EXPECT_TRUE(std::is_sorted(copies.first_reader.begin(), copies.first_reader.end()));
    for (std::size_t copy = 0; copy < copies.count(); ++copy) EXPECT_EQ(copies.of(copies.first_reader[copy]), copy);
    EXPECT_EQ(copies.of(std::numeric_limits<schedule::reader>::max()), copies.count() - 1);
  }
  EXPECT_GT(p.spare_bits, spare);
  // Few readers: every flip-flop is the only one.
  const graph few = make_adder_pipeline();
  const emit::plan plain = emit::make_plan(few, model, schedule::make_schedule(few, model, {}));
  EXPECT_TRUE(plain.value_copies.empty());
  EXPECT_EQ(plain.spare_bits, 0u);
}

TEST(emit_verilog, divides_readers_among_the_copies_that_were_made_for_them) {
  const schedule::delay_model model("ecp5");
  constexpr unsigned levels = 96;
  const graph g = make_cleared_levels(levels);
  const schedule::result s = schedule::make_schedule(g, model, {});
  const std::string verilog = emit::emit_verilog(g, model, s);
  std::map<std::string, unsigned> clears;  // by the flip-flop that the choice names
  const std::regex choice(R"((\w+) \? \w+ : 16'd0;)");
  for (std::sregex_iterator at(verilog.begin(), verilog.end(), choice), end; at != end; ++at) ++clears[(*at)[1]];
  // A clear serves whole slices, so that a copy clears three times as many bits as it could drive gates.
  EXPECT_LE(clears.size(), levels * 16 / model.parameters().most_enabled * 5 / 4);
  unsigned total = 0;
  for (const auto& [name, count] : clears) {
    EXPECT_LE(count * 16, model.parameters().most_enabled + 16) << name;
    total += count;
  }
  EXPECT_EQ(total, levels);
}

TEST(make_plan, brings_early_conditions_to_rams_without_a_gate) {
  const schedule::delay_model model("ecp5");
  const graph g = make_late_write(20);
  const schedule::result s = schedule::make_schedule(g, model, {});
  const emit::plan p = emit::make_plan(g, model, s);
  ASSERT_EQ(p.update_bits.size(), 1u);
  const auto write = std::find_if(g.nodes.begin(), g.nodes.end(),
                                  [](const dataflow::node& n) { return n.kind == operation::memory_write; });
  EXPECT_EQ(p.update_bits.begin()->first.first, write->operands[2]);
  const std::string verilog = emit::emit_verilog(g, model, s);
  EXPECT_THAT(verilog, ::testing::ContainsRegex("if \\([a-z0-9_]+_enable_[0-9]+\\) ring\\["));
}

TEST(make_plan, gives_fifos_room_for_all_in_flight) {
  const schedule::delay_model model("ecp5");
  for (const unsigned chain : {1u, 12u, 60u}) {
    const graph g = make_long_wait(chain);
    const schedule::result s = schedule::make_schedule(g, model, {});
    const emit::plan p = emit::make_plan(g, model, s);
    ASSERT_EQ(p.fifos.size(), 1u);
    EXPECT_GE(p.fifos[0].depth, static_cast<unsigned>(s.depth + 6));
    EXPECT_EQ(p.fifos[0].depth & (p.fifos[0].depth - 1), 0u);
  }
}

}  // namespace
}  // namespace epiline::testing
