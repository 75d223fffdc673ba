// The report: a stable schema, an interface a testbench can bind, figures that agree with the schedule and the plan.

#include "emit/report.hpp"

#include <gtest/gtest.h>

#include "emit/report_page.hpp"
#include "emit/verilog.hpp"
#include "example_graphs.hpp"

namespace epiline::testing {
namespace {

using nlohmann::json;

json report_of(const graph& g, double period = 6) {
  const schedule::delay_model model("ecp5");
  return emit::make_report(g, model, schedule::make_schedule(g, model, {.period = period}));
}

TEST(report, has_the_schema_and_every_part) {
  const json report = report_of(make_calls());
  EXPECT_EQ(report["schema"], "epiline-report/4");
  EXPECT_EQ(report["schema_version"], 4);
  for (const char* key : {"top",       "target",    "clock",          "initiation_interval",
                          "depth",     "interface", "latency_clocks", "stages",
                          "registers", "memories",  "tables",         "delay_lines",
                          "fifos",     "estimate",  "critical_chain", "limiting_recurrence",
                          "limit",     "lines",     "variables",      "passes",
                          "prediction"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["top"], "calls");
  EXPECT_EQ(report["target"], "ecp5");
  EXPECT_EQ(report["initiation_interval"], 1);
  EXPECT_EQ(report["stages"].size(), report["depth"]);
  EXPECT_GT(report["drain_clocks_per_call"], 0);
}

TEST(report, describes_every_port_as_emitted) {
  const graph g = make_calls();
  const schedule::delay_model model("ecp5");
  const std::string verilog = emit::emit_verilog(g, model, schedule::make_schedule(g, model, {}));
  const json ports = report_of(g)["interface"]["ports"];
  ASSERT_EQ(ports.size(), 4u);
  EXPECT_EQ(ports[0]["kind"], "call");
  EXPECT_EQ(ports[0]["fields"][1]["rtl"], "gain");
  EXPECT_EQ(ports[0]["fields"][1]["offset"], 6);
  EXPECT_EQ(ports[0]["valid"], "call_tvalid");
  EXPECT_EQ(ports[1]["fields"][0]["rtl"], "s_axis_in_tdata");
  EXPECT_EQ(ports[1]["direction"], "input");
  EXPECT_EQ(ports[2]["ready"], "m_axis_out_tready");
  EXPECT_EQ(ports[3]["kind"], "result");
  for (const json& port : ports) {
    const bool input = port["direction"] == "input";
    for (const json& f : port["fields"]) {
      const std::string declared = std::string(input ? "input  wire [" : "output wire [") +
                                   std::to_string(f["width"].get<unsigned>() - 1) + ":0] " +
                                   f["rtl"].get<std::string>();
      EXPECT_NE(verilog.find(declared), std::string::npos) << declared;
    }
    const std::string valid = std::string(input ? "input  wire " : "output wire ") + port["valid"].get<std::string>();
    EXPECT_NE(verilog.find(valid), std::string::npos) << valid;
  }
}

TEST(report, counts_memories_and_registers) {
  const json report = report_of(make_block_matcher(8));
  ASSERT_EQ(report["memories"].size(), 2u);
  const json& rows = report["memories"][0];
  EXPECT_EQ(rows["words"], 1024);
  EXPECT_EQ(rows["width"], 336);
  EXPECT_EQ(rows["block_rams"], 19);
  EXPECT_EQ(rows["copies"], 1);
  EXPECT_EQ(rows["storage"], "block");
  std::uint64_t bits = 0;
  for (const json& stage : report["stages"]) bits += stage["register_bits"].get<std::uint64_t>();
  EXPECT_EQ(bits, report["registers"]["pipeline_bits"]);
  EXPECT_EQ(report["registers"]["state_bits"], 10 + 8 * (7 * 15 + 18 + 48));
  EXPECT_EQ(report["estimate"]["block_rams"], 19 + report["memories"][1]["block_rams"].get<int>());
  EXPECT_GT(report["estimate"]["lut4"], 1000);
}

TEST(report, ranks_source_lines_by_their_cost) {
  const json lines = report_of(make_block_matcher(8))["estimate"]["by_line"];
  ASSERT_GT(lines.size(), 3u);
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_GE(lines[i - 1]["luts"], lines[i]["luts"]);
  EXPECT_EQ(lines[0]["where"]["line"], 102);
}

TEST(report, leads_all_that_waits_back_to_lines_and_variables) {
  const json report = report_of(make_block_matcher(8));
  double luts = 0;
  std::uint64_t lines = 0, waiting = 0, state = 0, memory = 0;
  for (const json& line : report["lines"]) {
    luts += line["luts"].get<double>();
    lines += line["waiting_bits"].get<std::uint64_t>();
  }
  for (const json& v : report["variables"]) {
    waiting += v["waiting_bits"].get<std::uint64_t>();
    state += v["state_bits"].get<std::uint64_t>();
    memory += v["memory_bits"].get<std::uint64_t>();
  }
  const json& registers = report["registers"];
  EXPECT_EQ(lines, registers["pipeline_bits"].get<std::uint64_t>());
  EXPECT_EQ(waiting,
            registers["pipeline_bits"].get<std::uint64_t>() + registers["ram_output_bits"].get<std::uint64_t>());
  EXPECT_EQ(state, registers["state_bits"].get<std::uint64_t>());
  std::uint64_t expected = 0;
  for (const json& m : report["memories"]) {
    expected += m["words"].get<std::uint64_t>() * m["width"].get<std::uint64_t>() * m["copies"].get<std::uint64_t>();
  }
  EXPECT_EQ(memory, expected);
  EXPECT_LE(luts, report["estimate"]["lut4"].get<double>());
  EXPECT_GT(luts, 0.5 * report["estimate"]["lut4"].get<double>());
}

TEST(report, says_what_limits_the_speed) {
  EXPECT_EQ(report_of(make_adder_pipeline())["limit"]["by"], "chain");
  const json tight = report_of(make_accumulator(16, 2), 5.7)["limit"];
  EXPECT_EQ(tight["by"], "recurrence");
  EXPECT_NE(tight["text"].get<std::string>().find("running_sum"), std::string::npos);
  EXPECT_FALSE(tight["suggestion"].get<std::string>().empty());
}

TEST(report_page, shows_the_source_and_escapes_everything) {
  graph g = make_histogram(4);
  g.name = "<script>alert(1)</script>";
  g.files = {"a&b/\"kernel\".cpp"};
  g.memories.at(0).name = "<b>'";
  const json report = report_of(g);
  std::string source;
  for (int line = 1; line <= 60; ++line) source += line == 31 ? "if (a < b && c > d) \"x\";\n" : "\n";
  const std::string page = emit::report_page(report, {{g.files[0], source}});
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<b>'"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(page.find("<td>if (a &lt; b &amp;&amp; c &gt; d) &quot;x&quot;;</td>"), std::string::npos);
  EXPECT_NE(page.find("a&amp;b/&quot;kernel&quot;.cpp"), std::string::npos);
  EXPECT_EQ(page, emit::report_page(report, {{g.files[0], source}}));
}

TEST(report_page, does_without_a_source_that_is_gone) {
  const json report = report_of(make_histogram(4));
  const std::string page = emit::report_page(report, {});
  EXPECT_NE(page.find("kernel.cpp:31"), std::string::npos);
  EXPECT_EQ(page.find("href"), std::string::npos);  // there is nothing to lead to
  for (const json& line : report["lines"]) {
    EXPECT_NE(page.find("l" + std::to_string(line["where"]["line"].get<unsigned>()) + "\""), std::string::npos);
  }
}

TEST(report, shows_the_critical_chain_and_the_recurrence) {
  const json report = report_of(make_accumulator(16, 2));
  const json& chain = report["critical_chain"];
  double sum = 0;
  for (const json& link : chain["links"]) sum += link["delay_ns"].get<double>();
  EXPECT_NEAR(chain["delay_ns"], sum + 1.32, 0.01);  // launch and capture beside the operations
  EXPECT_LE(chain["delay_ns"], 6.0);
  ASSERT_FALSE(report["limiting_recurrence"].is_null());
  EXPECT_EQ(report["limiting_recurrence"]["register"], "running_sum");
  EXPECT_NEAR(report["limiting_recurrence"]["delay_ns"], 1.32 + 2 * 2.15, 0.01);
  EXPECT_TRUE(report_of(make_adder_pipeline())["limiting_recurrence"].is_null());
}

TEST(report, carries_what_the_caller_gives) {
  const schedule::delay_model model("ecp5");
  const graph g = make_counter();
  const json passes = json::array({{{"name", "narrow"}, {"removed_bits", 12}}});
  const json report =
      emit::make_report(g, model, schedule::make_schedule(g, model, {}), {.delay_lines = {}, .passes = passes});
  EXPECT_EQ(report["passes"], passes);
  EXPECT_NE(emit::report_text(report).find("narrow"), std::string::npos);
}

TEST(report, reads_well_as_text) {
  const std::string text = emit::report_text(report_of(make_histogram(4)));
  for (const char* part : {"histogram: ", "Estimated size:", "m_axis_out_tdata[16]", "Slowest chain:", "256 x 16 bits",
                           "kernel.cpp:31", "Stages"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  EXPECT_EQ(text, emit::report_text(report_of(make_histogram(4))));
}

}  // namespace
}  // namespace epiline::testing
