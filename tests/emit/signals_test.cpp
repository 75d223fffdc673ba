// --explain: every name that stands in a generated module is led to its operation, stage and source lines.

#include "emit/signals.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <regex>

#include "dataflow/small_networks.hpp"
#include "emit/network_verilog.hpp"
#include "emit/verilog.hpp"
#include "eval/scratch_folder.hpp"
#include "example_graphs.hpp"

namespace epiline::testing {
namespace {

using emit::explain_signal;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

class signals : public ::testing::Test {
 protected:
  /// Writes the module's files as epiline-hls does; gives the Verilog.
  std::string write(const graph& g, const emit::verilog_options& options = {}) {
    const schedule::delay_model model("ecp5");
    const emit::verilog_text made =
        emit::emit_module(g, model, schedule::make_schedule(g, model, {.period = 10}), options);
    put(g.name + ".v", made.text);
    put(g.name + ".signals.json", emit::signals_text(made.modules));
    return made.text;
  }
  void put(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string explain(const std::string& name) { return explain_signal(name, folder_ / ""); }

  test::scratch_folder folder_;
};

/// What the modules of the top declare, but for those of the flow's own two small modules at the end.
std::set<std::string> declared_names(const std::string& verilog) {
  static const std::regex declaration(R"(\b(?:reg|wire)\b\s*(?:\[[^\]]*\])?\s*(\w+(?:,\s*\w+)*)\s*[;=\[])");
  const std::string text =
      std::regex_replace(verilog.substr(0, verilog.find("`ifndef EPILINE_")), std::regex("//[^\n]*"), "");
  std::set<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
    const std::string list = (*at)[1];
    static const std::regex word(R"(\w+)");
    for (std::sregex_iterator one(list.begin(), list.end(), word); one != end; ++one) names.insert(one->str());
  }
  return names;
}

TEST_F(signals, are_all_explained) {
  for (const graph& g :
       std::vector<graph>{make_counter(), make_adder_pipeline(), make_filter(), make_histogram(4),
                          make_conditional_streams(), make_accumulator(16, 2), make_calls(), make_long_wait(40),
                          make_many_waits(5), make_many_readers(80), make_small_memory(), make_two_writes(true),
                          make_two_writes(false), make_all_operations(), make_block_matcher(4)}) {
    const std::string verilog = write(g);
    const std::set<std::string> names = declared_names(verilog);
    EXPECT_GT(names.size(), 10u) << g.name;
    for (const std::string& name : names) EXPECT_THAT(explain(name), StartsWith(name + ": ")) << g.name;
    std::filesystem::remove(folder_ / (g.name + ".v"));
    std::filesystem::remove(folder_ / (g.name + ".signals.json"));
  }
  for (const std::string& name : declared_names(write(make_calls(), {.axi_lite = true}))) {
    EXPECT_THAT(explain(name), StartsWith(name + ": "));
  }
}

TEST_F(signals, of_processes_are_explained_in_their_modules) {
  const dataflow::network n = dataflow::testing::two_adders();
  const schedule::delay_model model("ecp5");
  std::vector<schedule::result> schedules;
  for (const graph& g : n.processes) schedules.push_back(schedule::make_schedule(g, model, {}));
  const emit::verilog_text made = emit::emit_network(n, model, schedules);
  put(n.name + ".v", made.text);
  put(n.name + ".signals.json", emit::signals_text(made.modules));
  const std::string processes = made.text.substr(0, made.text.find("\nmodule epiline_"));
  for (const std::string& name : declared_names(processes)) EXPECT_THAT(explain(name), HasSubstr(name + ": "));
  // Both processes have one.
  for (const graph& g : n.processes) EXPECT_THAT(explain("fire"), HasSubstr("in module " + g.name + "\nfire: control"));
  const std::string fifo = emit::fifo_instance_name(n.fifos[0]);
  EXPECT_THAT(explain("top." + fifo), HasSubstr(fifo + ": FIFO, the instance of '" + n.fifos[0].name + "'"));
}

TEST_F(signals, tell_operation_width_stage_and_lines) {
  graph g = make_accumulator(16, 2);
  (void)write(g);
  EXPECT_THAT(explain("running_sum"), StartsWith("running_sum: register, 16 bits, stage "));
  EXPECT_THAT(explain("running_sum"), HasSubstr("  kernel.cpp:"));
  EXPECT_THAT(explain("fire"), StartsWith("fire: control, 1 when an iteration is issued"));
  EXPECT_THAT(explain("m_axis_out_tdata"), StartsWith("m_axis_out_tdata: port signal, of 'out', 16 bits"));
}

TEST_F(signals, with_suffixes_are_told_with_what_they_belong_to) {
  const std::string verilog = write(make_many_readers(80));
  std::smatch found;
  ASSERT_TRUE(std::regex_search(verilog, found, std::regex(R"(\b(([a-z]\w*)_s(\d+))_copy1\b)")));
  const std::string copy = found[0], waiting = found[1], base = found[2], stage = found[3];
  EXPECT_THAT(explain(copy),
              StartsWith(copy + ": copy 1 of the flip-flops '" + waiting + "', for some of their readers\n" + waiting +
                         ": flip-flops that hold '" + base + "' in stage " + stage + "\n" + base + ": "));
}

TEST_F(signals, are_known_by_the_names_of_simulators_and_timing_reports) {
  (void)write(make_accumulator(16, 2));
  const std::string plain = explain("running_sum");
  for (const char* name :
       {"top.dut.running_sum[3]", "running_sum[15:0]", "dut/running_sum", "\\running_sum ", " running_sum"})
    EXPECT_EQ(explain(name), plain) << name;
}

TEST_F(signals, show_the_source_line_when_the_file_is_there) {
  graph g = make_accumulator(16, 2);
  put("k.cpp", "\n  running_sum += x;  // here\n");
  g.files = {folder_ / "k.cpp"};
  for (dataflow::register_state& r : g.registers) r.where = {0, 2};
  (void)write(g);
  EXPECT_THAT(explain("running_sum"), HasSubstr("k.cpp:2: running_sum += x;  // here\n"));
}

TEST_F(signals, that_no_module_has_are_refused_with_the_nearest) {
  (void)write(make_accumulator(16, 2));
  for (const char* name : {"running_sun", "running_sum_s99", "", "[3]", "running_sum_copy7"})
    EXPECT_THROW((void)explain(name), emit::unknown_signal) << name;
  EXPECT_THAT([&] { (void)explain("running_sun"); },
              ThrowsMessage<emit::unknown_signal>(HasSubstr("the nearest are 'running_sum'")));
  // Words of Verilog are no signals.
  EXPECT_THROW((void)explain("always"), emit::unknown_signal);
}

TEST_F(signals, need_a_folder_that_epiline_hls_wrote) {
  const auto refuses = [&](const std::string& words) {
    EXPECT_THAT([&] { (void)explain("fire"); }, ThrowsMessage<std::invalid_argument>(HasSubstr(words)));
  };
  EXPECT_THAT([&] { (void)explain_signal("fire", folder_ / "none"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("cannot be read")));
  refuses("no *.signals.json in it");
  put("x.signals.json", "{}");
  refuses("x.v, which it speaks of, is missing");
  put("x.v", "module x(input wire fire); endmodule");
  for (const char* text : {"", "{", "[]", "{}", "{\"schema\": \"other\"}"}) {
    put("x.signals.json", text);
    refuses("not a file of epiline-hls");
  }
  for (const char* rest : {"", ", \"modules\": 3", ", \"modules\": [{}]",
                           ", \"modules\": [{\"module\": \"x\", \"files\": 3, \"signals\": []}]",
                           ", \"modules\": [{\"module\": \"x\", \"files\": [], \"signals\": [{}]}]",
                           ", \"modules\": [{\"module\": \"x\", \"files\": [], \"signals\": [{\"name\": \"fire\", "
                           "\"kind\": \"\", \"what\": \"\", \"width\": 1, \"stage\": 0, \"where\": [[0]]}]}]"}) {
    put("x.signals.json", std::string("{\"schema\": \"epiline-signals/1\"") + rest + "}");
    refuses("damaged");
  }
}

}  // namespace
}  // namespace epiline::testing
