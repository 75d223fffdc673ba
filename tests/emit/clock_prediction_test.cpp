// The predicted clock: the longest chain in delays of cells and wires, which grow with the design and with the readers.

#include "emit/clock_prediction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dataflow/small_networks.hpp"
#include "emit/network_report.hpp"
#include "example_graphs.hpp"

namespace epiline::testing {
namespace {

using emit::clock_prediction;
using emit::design_size;
using emit::device_delays;
using nlohmann::json;

device_delays delays() { return *emit::fitted_delays("ecp5"); }

clock_prediction predict(const graph& g, const device_delays& d, const design_size& size = {100, 100}) {
  const schedule::delay_model model("ecp5");
  const schedule::result s = schedule::make_schedule(g, model, {});
  return emit::predict_clock(g, model, s, emit::make_plan(g, model, s), d, size);
}

/// A file of delays whose text `change` spoils.
template <class Change>
std::string file_with(Change change) {
  json all = {{"schema", "epiline-device-delays/1"}, {"target", "ecp5"}};
  for (const char* name : {"clock_to_out", "lut", "carry_entry", "carry_bit", "carry_exit", "multiplier",
                           "distributed_read", "block_clock_to_out", "block_setup", "setup", "enable_setup"})
    all["cells_ns"][name] = 0.25;
  for (const char* name : {"wire", "reader_doubling", "block_wire", "side_doubling"}) all["wires_ns"][name] = 0.5;
  change(all);
  return all.dump();
}

TEST(clock_prediction, is_built_in_for_the_device_it_was_fitted_to) {
  EXPECT_TRUE(emit::fitted_delays("ecp5"));
  EXPECT_FALSE(emit::fitted_delays("hx8k"));
  EXPECT_FALSE(emit::fitted_delays("generic"));
}

TEST(clock_prediction, reads_a_file_of_delays) {
  const device_delays d = emit::read_device_delays(file_with([](json& all) { all["cells_ns"]["lut"] = 0.125; }));
  EXPECT_EQ(d.lut, 0.125);
  EXPECT_EQ(d.carry_exit, 0.25);
  EXPECT_EQ(d.side_doubling, 0.5);
}

TEST(clock_prediction, refuses_files_that_say_no_delays) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(emit::read_device_delays(text));
    } catch (const std::invalid_argument& wrong) {
      return wrong.what();
    }
    return "";
  };
  EXPECT_NE(message("{").find("epiline-device-delays/1"), std::string::npos);
  EXPECT_NE(message("[]").find("epiline-device-delays/1"), std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all["schema"] = "other"; })).find("epiline-device-delays/1"),
            std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all["schema"] = 1; })).find("epiline-device-delays/1"),
            std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all.erase("wires_ns"); })).find("wires_ns.wire"), std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all["cells_ns"] = 1; })).find("cells_ns."), std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all["cells_ns"].erase("lut"); })).find("cells_ns.lut"),
            std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all["cells_ns"]["lut"] = "fast"; })).find("cells_ns.lut"),
            std::string::npos);
  EXPECT_NE(message(file_with([](json& all) { all["cells_ns"]["lut"] = -1; })).find("cells_ns.lut"), std::string::npos);
}

// Whoever fits other delays to the chains of a report gets the period that the compiler would predict in them.
TEST(clock_prediction, is_the_longest_of_its_chains) {
  for (const graph& g : {make_calls(), make_filter(), make_histogram(4), make_small_memory(), make_block_matcher(4)}) {
    const device_delays d = delays();
    const clock_prediction found = predict(g, d);
    const auto period = [&](const emit::timed_chain& c) {
      return c.cells + c.wires * d.wire + c.doublings * d.reader_doubling +
             d.side_doubling * std::log2(std::max(1.0, found.side / emit::compact_side));
    };
    ASSERT_FALSE(found.chains.empty());
    double longest = 0;
    for (const emit::timed_chain& c : found.chains) longest = std::max(longest, period(c));
    EXPECT_NEAR(found.period, longest, 0.1) << g.name;
    EXPECT_DOUBLE_EQ(found.period, period(found.longest)) << g.name;
    EXPECT_FALSE(found.end.empty()) << g.name;
  }
}

TEST(clock_prediction, grows_with_the_design) {
  EXPECT_DOUBLE_EQ(design_size({100, 400}).side(), 20);
  EXPECT_DOUBLE_EQ(design_size({900, 400}).side(), 30);
  device_delays d = delays();
  d.side_doubling = 0.5;
  const graph g = make_filter();
  EXPECT_NEAR(predict(g, d, {10000, 0}).period - predict(g, d, {625, 0}).period, 1, 1e-9);
  EXPECT_DOUBLE_EQ(predict(g, d, {64, 0}).period, predict(g, d, {1, 0}).period);
}

TEST(clock_prediction, grows_with_every_delay_on_the_chain) {
  const graph g = make_accumulator(32, 1);
  const clock_prediction before = predict(g, delays());
  for (double device_delays::* const one :
       {&device_delays::clock_to_out, &device_delays::carry_entry, &device_delays::carry_bit,
        &device_delays::carry_exit, &device_delays::wire}) {
    device_delays d = delays();
    d.*one += 0.1;
    EXPECT_GT(predict(g, d).period, before.period + 0.09);
  }
  device_delays d = delays();
  d.multiplier += 5;  // there is none
  EXPECT_EQ(predict(g, d).period, before.period);
}

TEST(clock_prediction, grows_with_the_readers) {
  device_delays d = delays();
  d.reader_doubling = 0;
  const double without = predict(make_many_readers(64), d).period;
  d.reader_doubling = 0.2;
  EXPECT_GT(predict(make_many_readers(64), d).period, without + 0.19);
}

TEST(clock_prediction, takes_all_processes_for_one_design) {
  const dataflow::network n = dataflow::testing::sort_and_merge(4);
  const schedule::delay_model model("ecp5");
  std::vector<schedule::result> schedules;
  for (const dataflow::graph& g : n.processes) schedules.push_back(schedule::make_schedule(g, model, {}));
  const std::vector<json> passes(n.processes.size(), json::array());
  const json report = emit::make_network_report(n, model, schedules, passes, false, delays());
  double slowest = 0;
  for (const json& process : report["processes"]) {
    const json& one = process["report"]["prediction"];
    EXPECT_EQ(one["side"], report["prediction"]["side"]);
    slowest = std::max(slowest, one["period_ns"].get<double>());
  }
  EXPECT_EQ(report["prediction"]["period_ns"], slowest);
  EXPECT_NE(emit::network_report_text(report).find("MHz (predicted)"), std::string::npos);
  const json without = emit::make_network_report(n, model, schedules, passes, false);
  EXPECT_TRUE(without["prediction"].is_null());
  EXPECT_EQ(emit::network_report_text(without).find("predicted"), std::string::npos);
}

}  // namespace
}  // namespace epiline::testing
