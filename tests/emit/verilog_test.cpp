// Emitted Verilog against the interpreter, under gaps and back-pressure, for hand-made graphs.

#include "emit/verilog.hpp"

#include <gtest/gtest.h>

#include <filesystem>

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
  add(make_small_memory());
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

TEST_P(every_example, does_what_the_interpreter_does) {
  const example& e = GetParam();
  const schedule::delay_model model("ecp5");
  const std::vector<token_list> inputs = inputs_for(e, 300);
  const std::vector<token_list> expected = interpret(e.g, inputs);
  std::size_t tokens = 0;
  for (const token_list& list : expected) tokens += list.size();
  EXPECT_GT(tokens, 20u);
  for (unsigned trial = 0; trial < 5; ++trial) {
    const schedule::result s =
        trial < 3 ? schedule::make_schedule(e.g, model, {e.period, e.interval})
                  : schedule::make_random_schedule(e.g, model, {e.period, e.interval}, trial);
    ASSERT_EQ(schedule::validate(e.g, model, s), "");
    const std::string folder = scratch_folder("run-" + e.name);
    const unsigned gaps[] = {0, 40, 85, 0, 40};
    const simulation_result r =
        simulate(e.g, emit::emit_verilog(e.g, model, s), inputs, folder, {.gap_percent = gaps[trial], .seed = trial + 1});
    ASSERT_EQ(r.problem, "") << folder;
    for (std::size_t i = 0; i < e.g.ports.size(); ++i) {
      ASSERT_EQ(r.outputs[i].size(), expected[i].size()) << e.g.ports[i].name << " in " << folder;
      for (std::size_t t = 0; t < expected[i].size(); ++t) {
        ASSERT_EQ(r.outputs[i][t], expected[i][t]) << e.g.ports[i].name << " token " << t << " in " << folder;
      }
    }
    std::filesystem::remove_all(folder);
  }
}

INSTANTIATE_TEST_SUITE_P(graphs, every_example, ::testing::ValuesIn(examples()),
                         [](const ::testing::TestParamInfo<example>& info) { return info.param.name; });

}  // namespace
}  // namespace epiline::testing
