// Arguments as registers: addresses for every width and sign, and the files that tell software, tools and people.

#include "emit/register_map.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "emit/interface.hpp"
#include "emit/report.hpp"
#include "emit/verilog.hpp"
#include "example_graphs.hpp"
#include "rtl_simulation.hpp"

namespace epiline::testing {
namespace {

using emit::argument_register;
using emit::register_map;
using nlohmann::json;

struct scalar {
  std::string name;
  unsigned width;
  bool is_signed;
};

/// A top that forwards its stream and has these scalars.
graph top_with(const std::vector<scalar>& scalars, bool has_input = true) {
  graph_builder b("thing");
  std::vector<std::pair<std::string, unsigned>> fields;
  for (const scalar& s : scalars) fields.emplace_back(s.name, s.width);
  const auto out = b.stream("out", false, 8);
  const node_id one = b.always();
  node_id value = b.constant(8, 1);
  if (has_input) value = b.read(b.stream("in", true, 8), one);
  if (!scalars.empty()) {
    b.line = 7;
    const auto call = b.port("call", dataflow::port_kind::call, true, fields);
    for (std::size_t i = 0; i < scalars.size(); ++i) b.g.ports[call].fields[i].is_signed = scalars[i].is_signed;
    b.read(call, one);
  }
  b.write(out, one, value);
  return b.g;
}

const std::vector<scalar> every_width = {{"w1", 1, false},  {"s1", 1, true},    {"s5", 5, true},    {"w31", 31, false},
                                         {"s32", 32, true}, {"w32", 32, false}, {"w33", 33, false}, {"s33", 33, true},
                                         {"s64", 64, true}, {"w64", 64, false}, {"s65", 65, true},  {"w65", 65, false}};

std::string verilog_of(const graph& g) {
  const schedule::delay_model model("ecp5");
  return emit::emit_verilog(g, model, schedule::make_schedule(g, model, {}), {.axi_lite = true});
}

/// What is thrown, as text.
template <class Action>
std::string refusal_of(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& refusal) {
    return refusal.what();
  }
  return "nothing";
}

TEST(register_map, gives_every_argument_words_of_its_own) {
  const register_map map = emit::make_register_map(top_with(every_width));
  ASSERT_EQ(map.arguments.size(), every_width.size());
  unsigned address = 0x10;
  unsigned offset = 0;
  for (std::size_t i = 0; i < every_width.size(); ++i) {
    const argument_register& argument = map.arguments[i];
    const unsigned width = every_width[i].width;
    EXPECT_EQ(argument.name, every_width[i].name);
    EXPECT_EQ(argument.address, address) << argument.name;
    EXPECT_EQ(argument.words, width <= 32 ? 1u : width <= 64 ? 2u : 3u) << argument.name;
    EXPECT_EQ(argument.offset, offset) << argument.name;
    EXPECT_EQ(argument.is_signed, every_width[i].is_signed) << argument.name;
    address += 4 * argument.words;
    offset += width;
  }
  EXPECT_EQ(map.argument_bits, offset);
  EXPECT_EQ(map.address_bits, 12u);
  EXPECT_EQ(map.place, "kernel.cpp:7");
}

TEST(register_map, the_address_grows_with_the_arguments) {
  // 1020 words after the four fixed ones fill 4 KiB.
  EXPECT_EQ(emit::make_register_map(top_with({{"a", 1020 * 32, false}})).address_bits, 12u);
  EXPECT_EQ(emit::make_register_map(top_with({{"a", 1020 * 32, false}, {"b", 1, false}})).address_bits, 13u);
}

TEST(register_map, a_top_without_scalars_is_refused) {
  const graph g = top_with({});
  EXPECT_EQ(refusal_of([&] { static_cast<void>(emit::make_register_map(g)); }),
            "--axi-lite: the top 'thing' has no scalar arguments to put into registers: leave the option out");
  EXPECT_EQ(refusal_of([&] { static_cast<void>(verilog_of(g)); }),
            "--axi-lite: the top 'thing' has no scalar arguments to put into registers: leave the option out");
}

TEST(register_map, a_name_that_verilog_cannot_have_is_refused_and_a_keyword_is_none) {
  EXPECT_NE(refusal_of([] {
              static_cast<void>(
                  verilog_of(top_with({{"gr\xc3\xb6\xc3\x9f"
                                        "e",
                                        4, false}})));
            }).find("cannot have that name in Verilog: rename it"),
            std::string::npos);
  EXPECT_EQ(refusal_of([] { static_cast<void>(verilog_of(top_with({{"wire", 4, false}, {"clk", 3, true}}))); }),
            "nothing");
}

TEST(register_map, json_says_all_that_a_master_needs) {
  const register_map map = emit::make_register_map(top_with(every_width));
  const json described = emit::to_json(map);
  EXPECT_EQ(described["schema"], "epiline-registers/1");
  EXPECT_EQ(described["top"], "thing");
  EXPECT_EQ(described["prefix"], "s_axi");
  EXPECT_EQ(described["data_bits"], 32);
  EXPECT_EQ(described["address_bits"], 12);
  EXPECT_EQ(described["calls_wait_for_input"], true);
  const json& registers = described["registers"];
  ASSERT_EQ(registers.size(), 2 + every_width.size());
  EXPECT_EQ(registers[0]["name"], "control");
  EXPECT_EQ(registers[0]["bits"].size(), 3u);
  EXPECT_EQ(registers[0]["bits"][2]["name"], "keep");
  EXPECT_EQ(registers[0]["bits"][2]["low"], 2);
  EXPECT_EQ(registers[1]["name"], "calls");
  EXPECT_EQ(registers[1]["access"], "read-only");
  for (std::size_t i = 0; i < every_width.size(); ++i) {
    const json& entry = registers[2 + i];
    EXPECT_EQ(entry["name"], every_width[i].name);
    EXPECT_EQ(entry["kind"], "argument");
    EXPECT_EQ(entry["address"], map.arguments[i].address);
    EXPECT_EQ(entry["width"], every_width[i].width);
    EXPECT_EQ(entry["signed"], every_width[i].is_signed);
    EXPECT_EQ(entry["reset"], 0);
  }
}

TEST(register_map, markdown_has_a_row_for_every_word) {
  const std::string text = emit::to_markdown(emit::make_register_map(top_with({{"w1", 1, false}, {"s65", 65, true}})));
  for (const char* row : {"| 0x000 | 2 | control: `keep` | read-write |", "| 0x004 | 31..0 | calls | read-only |",
                          "| 0x010 | 0 | `w1` | read-write |", "| 0x014 | 31..0 | `s65`[31:0] | read-write |",
                          "| 0x018 | 31..0 | `s65`[63:32] | read-write |", "| 0x01c | 0 | `s65`[64] | read-write |"}) {
    EXPECT_NE(text.find(row), std::string::npos) << row << " is not in\n" << text;
  }
}

TEST(register_map, without_input_streams_software_starts_the_calls) {
  const graph g = top_with({{"a", 4, false}}, false);
  const register_map map = emit::make_register_map(g);
  EXPECT_FALSE(map.waits_for_input);
  EXPECT_NE(emit::to_markdown(map).find("started with the bit `start`"), std::string::npos);
  EXPECT_NE(verilog_of(g).find("call_sample = call_wanted & ~call_there & call_start;"), std::string::npos);
}

/// Software for the register map, with an array where the hardware would be.
constexpr const char* program = R"(
#include "registers.h"
#include <assert.h>

int main(void) {
  uint32_t words[64] = {0};
  volatile uint32_t* registers = words;
  uint32_t wide[3] = {7, 8, 1}, back[3];
  thing_set_s5(registers, -3);
  assert(words[thing_s5_ADDRESS / 4] == 0xfffffffdu && thing_get_s5(registers) == -3);
  assert(thing_s5_BITS == 5 && thing_s5_SIGNED == 1 && thing_w31_SIGNED == 0);
  thing_set_w33(registers, 0x1abcdef01u);
  assert(words[thing_w33_ADDRESS / 4] == 0xabcdef01u && words[thing_w33_ADDRESS / 4 + 1] == 1);
  assert(thing_get_w33(registers) == 0x1abcdef01u);
  thing_set_s64(registers, -2);
  assert(words[thing_s64_ADDRESS / 4] == 0xfffffffeu && thing_get_s64(registers) == -2);
  thing_set_s65(registers, wide);
  thing_get_s65(registers, back);
  assert(thing_s65_WORDS == 3 && words[thing_s65_ADDRESS / 4 + 2] == 1 && back[0] == 7 && back[1] == 8 && back[2] == 1);
  words[thing_CALLS / 4] = 12;
  assert(thing_calls(registers) == 12);
  words[thing_CONTROL / 4] = thing_CONTROL_START;  /* a start that is pending is not asked for again */
  thing_begin_update(registers);
  assert(words[thing_CONTROL / 4] == thing_CONTROL_KEEP);
  thing_hold(registers);
  assert(words[thing_CONTROL / 4] == (thing_CONTROL_KEEP | thing_CONTROL_HOLD));
  thing_end_update(registers);
  assert(words[thing_CONTROL / 4] == thing_CONTROL_HOLD);
  thing_start(registers);
  assert(words[thing_CONTROL / 4] == (thing_CONTROL_HOLD | thing_CONTROL_START));
  thing_release(registers);
  assert(words[thing_CONTROL / 4] == 0);
  assert(thing_w1_ADDRESS == 0x10);
  return 0;
}
)";

TEST(register_map, the_header_works_in_c_and_in_cxx) {
  const std::string folder = scratch_folder("registers");
  std::ofstream(folder + "/registers.h") << emit::to_c_header(emit::make_register_map(top_with(every_width)));
  std::ofstream(folder + "/program.c") << program;
  for (const char* compiler : {"clang++-19 -x c -std=c99", "clang++-19 -x c++ -std=c++17"}) {
    EXPECT_EQ(run("cd " + folder + " && " + compiler +
                      " -Wall -Wextra -Wpedantic -Wno-unused-function -Werror program.c -o program && ./program",
                  folder + "/log"),
              "")
        << compiler;
  }
  std::filesystem::remove_all(folder);
}

TEST(register_map, the_module_with_its_slave_is_clean_verilog) {
  for (const graph& g : {top_with(every_width), top_with({{"a", 1, false}}, false), make_calls()}) {
    const std::string folder = scratch_folder("lint-axi-" + g.name);
    EXPECT_EQ(lint(g, verilog_of(g), folder), "") << folder;
    std::filesystem::remove_all(folder);
  }
}

TEST(register_map, the_arguments_are_no_ports_and_the_report_says_so) {
  const graph g = make_calls();
  const std::string verilog = verilog_of(g);
  for (const char* gone : {"call_tvalid", "call_tready", "wire [7:0] gain"}) {
    EXPECT_EQ(verilog.find(gone), std::string::npos) << gone;
  }
  EXPECT_EQ(verilog, verilog_of(g));
  const schedule::delay_model model("ecp5");
  const schedule::result s = schedule::make_schedule(g, model, {});
  const json report = emit::make_report(g, model, s, {.axi_lite = true});
  const json& interface = report["interface"];
  std::vector<std::string> channels;
  for (const json& port : interface["ports"]) {
    EXPECT_NE(port["kind"], "call");
    if (port["kind"] == "axi_lite") channels.push_back(port["name"]);
    for (const json& f : port["fields"]) {
      EXPECT_NE(verilog.find(f["rtl"].get<std::string>() + (port["direction"] == "input" ? ",\n" : "")),
                std::string::npos)
          << f["rtl"];
    }
  }
  EXPECT_EQ(channels, (std::vector<std::string>{"s_axi_aw", "s_axi_w", "s_axi_b", "s_axi_ar", "s_axi_r"}));
  EXPECT_EQ(interface["registers"], emit::to_json(emit::make_register_map(g)));
  EXPECT_NE(emit::report_text(report).find("0x014 gain"), std::string::npos);
  // Without the option nothing of it is there.
  EXPECT_FALSE(emit::make_report(g, model, s)["interface"].contains("registers"));
  EXPECT_EQ(emit::emit_verilog(g, model, s).find("s_axi_"), std::string::npos);
}

}  // namespace
}  // namespace epiline::testing
