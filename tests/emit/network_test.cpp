// Verilog and report of networks: clean for every tool, the same every time, and the FIFOs in both.

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "dataflow/small_networks.hpp"
#include "emit/network_report.hpp"
#include "emit/network_verilog.hpp"
#include "emit/report_page.hpp"
#include "rtl_simulation.hpp"

namespace epiline::testing {
namespace {

using dataflow::network;
using dataflow::testing::sort_and_merge;
using dataflow::testing::two_adders;
using nlohmann::json;

struct emitted {
  schedule::delay_model model{"ecp5"};
  std::vector<schedule::result> schedules;
  std::string verilog;
  json report;

  explicit emitted(const network& n) {
    for (const dataflow::graph& g : n.processes) schedules.push_back(schedule::make_schedule(g, model, {}));
    verilog = emit::emit_network(n, model, schedules).text;
    report =
        emit::make_network_report(n, model, schedules, std::vector<json>(n.processes.size(), json::array()), false);
  }
};

TEST(network_verilog, is_clean_for_every_tool) {
  // LUT RAM, block RAM, a depth that is no power of two, a depth of one, scalars of which one is used by nobody.
  for (network n : {sort_and_merge(1), sort_and_merge(100), two_adders()}) {
    n.name += "_" + std::to_string(n.fifos[0].depth);
    const std::string folder = scratch_folder("lint-" + n.name);
    EXPECT_EQ(lint(emit::outside_of(n), emitted(n).verilog, folder), "");
    std::filesystem::remove_all(folder);
  }
}

TEST(network_verilog, is_the_same_every_time) {
  EXPECT_EQ(emitted(sort_and_merge(4)).verilog, emitted(sort_and_merge(4)).verilog);
}

TEST(network_verilog, names_the_lines_of_streams_and_calls) {
  const std::string text = emitted(sort_and_merge(4)).verilog;
  for (const char* words : {"// ---- stream odd, 4 deep ----  // some \"place\".cpp:11",
                            "// ---- process merger ----  // some \"place\".cpp:21", ") odd_fifo (", "module sorter ("})
    EXPECT_NE(text.find(words), std::string::npos) << words;
}

TEST(network_verilog, gives_its_own_signals_other_names_than_the_users) {
  network n = two_adders();
  // A scalar that is called like a wire of the FIFO, and like the instance of a process.
  n.ports[2].fields[0].signal = n.ports[2].fields[0].name = "between_in_tdata";
  n.ports[2].fields[2].signal = n.ports[2].fields[2].name = "first_process";
  n.processes[0].ports[1].fields[0].signal = n.processes[0].ports[1].fields[0].name = "first_process";
  ASSERT_EQ(dataflow::find_violation(n), "");
  const std::string folder = scratch_folder("lint-clash");
  EXPECT_EQ(lint(emit::outside_of(n), emitted(n).verilog, folder), "");
  std::filesystem::remove_all(folder);
}

TEST(network_verilog, refuses_names_that_cannot_stand_in_verilog) {
  network n = two_adders();
  n.ports[2].fields[0].signal = "wire";
  EXPECT_THROW(emitted{n}, std::invalid_argument);
}

TEST(network_verilog, of_one_graph_is_its_own) {
  const dataflow::graph g = dataflow::testing::sorter();
  const schedule::delay_model model("ecp5");
  const std::vector<schedule::result> schedules = {schedule::make_schedule(g, model, {})};
  EXPECT_EQ(emit::emit_network(dataflow::network_of(g), model, schedules).text,
            emit::emit_verilog(g, model, schedules.front()));
  EXPECT_EQ(emit::make_network_report(dataflow::network_of(g), model, schedules, {json::array()}, false),
            emit::make_report(g, model, schedules.front()));
}

TEST(network_report, lists_the_fifos_and_adds_up) {
  network n = sort_and_merge(40);
  n.fifos[1].depth = 2000;
  const json report = emitted(n).report;
  ASSERT_EQ(report["streams"].size(), 2u);
  const json& odd = report["streams"][0];
  EXPECT_EQ(odd["name"], "odd");
  EXPECT_EQ(odd["instance"], "odd_fifo");
  EXPECT_EQ(odd["depth"], 40);
  EXPECT_EQ(odd["width"], 8);
  EXPECT_EQ(odd["writer"], "sorter");
  EXPECT_EQ(odd["reader"], "merger");
  EXPECT_EQ(odd["where"]["line"], 11);
  EXPECT_EQ(odd["storage"], "distributed");
  EXPECT_EQ(odd["block_rams"], 0);
  EXPECT_GT(odd["lut4"], 0);
  const json& even = report["streams"][1];
  EXPECT_EQ(even["storage"], "block");
  EXPECT_GT(even["block_rams"], 0);
  std::uint64_t flip_flops = odd["flip_flops"].get<unsigned>() + even["flip_flops"].get<unsigned>();
  for (const json& process : report["processes"])
    flip_flops += process["report"]["registers"]["total_bits"].get<std::uint64_t>();
  EXPECT_EQ(report["registers"]["total_bits"], flip_flops);
  EXPECT_EQ(report["processes"][1]["called"]["line"], 21);
  EXPECT_EQ(report["interface"]["module"], "sort_and_merge");
  const std::string text = emit::network_report_text(report);
  EXPECT_NE(text.find("odd: 40 x 8 bits, from sorter to merger"), std::string::npos) << text;
  EXPECT_EQ(odd["peak_fill"], nullptr);
  EXPECT_NE(text.find("process sorter: "), std::string::npos) << text;
}

TEST(network_report, shows_how_full_a_simulation_saw_the_fifos) {
  json report = emitted(sort_and_merge(40)).report;
  EXPECT_NE(emit::report_page(report, {}).find("not simulated"), std::string::npos);
  emit::add_peak_fills(report, {7, 0});
  EXPECT_EQ(report["streams"][0]["peak_fill"], 7);
  EXPECT_EQ(report["streams"][1]["peak_fill"], 0);
  const std::string text = emit::network_report_text(report);
  EXPECT_NE(text.find("odd: 40 x 8 bits (at most 7 held), from sorter to merger"), std::string::npos) << text;
  const std::string page = emit::report_page(report, {});
  EXPECT_EQ(page.find("not simulated"), std::string::npos);
  EXPECT_NE(page.find("<td class=\"n\">40</td><td class=\"n\">7</td>"), std::string::npos) << page;
}

}  // namespace
}  // namespace epiline::testing
