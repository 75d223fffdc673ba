#include "rtl_simulation.hpp"

#include <fmt/format.h>
#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/SmallString.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "dataflow/interpreter.hpp"
#include "emit/interface.hpp"

namespace epiline::testing {

namespace {

std::string hex(const llvm::APInt& value) {
  llvm::SmallString<64> digits;
  value.toString(digits, 16, false, false);
  return std::string(digits.str());
}

std::string range(unsigned width) { return fmt::format("[{}:0]", width - 1); }

void write_file(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// One clock of a port at a time: an independent driver of the RTL interface, in plain Verilog.
std::string make_testbench(const dataflow::graph& g, const std::vector<token_list>& inputs,
                           const simulation_options& options) {
  std::string declarations, connections, clocked, resets;
  for (std::size_t i = 0; i < g.ports.size(); ++i) {
    const dataflow::port& p = g.ports[i];
    const std::string valid = emit::signal_name(p, "tvalid");
    const std::string ready = emit::signal_name(p, "tready");
    connections += fmt::format(", .{}({}), .{}({})", valid, valid, ready, ready);
    for (const dataflow::field& f : p.fields) {
      const std::string rtl = emit::signal_name(p, f.signal);
      connections += fmt::format(", .{}(token{}[{}:{}])", rtl, i, f.offset + f.width - 1, f.offset);
    }
    if (p.input) {
      const std::size_t count = inputs[i].size();
      declarations += fmt::format("reg {} tokens{} [0:{}]; integer next{} = 0; reg {} = 0; wire {};\n", range(p.width),
                                  i, count, i, valid, ready);
      declarations += fmt::format("reg {} token{};\n", range(p.width), i);
      declarations += fmt::format("initial $readmemh(\"port{}.hex\", tokens{});\n", i, i);
      clocked += fmt::format(
          "  if ({0} && {1}) begin {0} <= 0; token{2} <= {4}'bx; activity = 1; end\n"
          "  if ((!{0} || {1}) && next{2} < {3} && ($unsigned($random(seed)) % 100) >= {5}) begin\n"
          "    {0} <= 1; token{2} <= tokens{2}[next{2}]; next{2} = next{2} + 1;\n  end\n",
          valid, ready, i, count, p.width, options.gap_percent);
    } else {
      declarations += fmt::format("wire {} token{}; wire {}; reg {} = 0; reg {} held{}; reg waiting{} = 0;\n",
                                  range(p.width), i, valid, ready, range(p.width), i, i);
      declarations += fmt::format("integer file{0}; initial file{0} = $fopen(\"port{0}.out\");\n", i);
      clocked += fmt::format(
          "  if ({0} === 1'bx) $display(\"PROBLEM {0} is unknown\");\n"
          "  if (waiting{2} && (!{0} || token{2} !== held{2})) $display(\"PROBLEM {0}: changed while it waited\");\n"
          "  waiting{2} = {0} && !{1}; held{2} = token{2};\n"
          "  if ({0} && {1}) begin $fdisplay(file{2}, \"%h\", token{2}); activity = 1; last = now; end\n"
          "  {1} <= ($unsigned($random(seed)) % 100) >= {3};\n",
          valid, ready, i, options.gap_percent);
    }
  }
  return fmt::format(
      "`timescale 1ns/1ns\nmodule testbench;\nreg clk = 0; reg rst = 1; integer seed = {}; integer now = 0;\n"
      "integer idle = 0; integer first = -1; integer last = 0; reg activity;\n{}"
      "{} dut(.clk(clk), .rst(rst){});\nalways #5 clk = ~clk;\n"
      "always @(posedge clk) if (now >= 5) begin\n  activity = 0;\n{}"
      "  if (activity) begin idle = 0; if (first < 0) first = now; end else idle = idle + 1;\n"
      "  if (idle > {} || now > {}) begin $display(\"CLOCKS %0d\", last - first); $finish; end\nend\n"
      "always @(posedge clk) begin now <= now + 1; rst <= now < 3; end\nendmodule\n",
      options.seed, declarations, g.name, connections, clocked, options.idle_clocks, options.most_clocks);
}

}  // namespace

std::string scratch_folder(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("epiline-emit-{}-{}", static_cast<int>(getpid()), name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

std::string run(const std::string& command, const std::string& log) {
  if (std::system(fmt::format("({}) > {} 2>&1", command, log).c_str()) == 0) return {};
  const std::string words = read_file(log);
  return words.empty() ? "failed without a word: " + command : words;
}

simulation_result simulate(const dataflow::graph& g, const std::string& verilog, const std::vector<token_list>& inputs,
                           const std::string& folder, const simulation_options& options) {
  simulation_result result;
  std::filesystem::create_directories(folder);
  write_file(folder + "/dut.v", verilog);
  write_file(folder + "/testbench.v", make_testbench(g, inputs, options));
  for (std::size_t i = 0; i < g.ports.size(); ++i) {
    if (!g.ports[i].input) continue;
    std::string text = "0\n";  // $readmemh refuses an empty file
    if (!inputs[i].empty()) text.clear();
    for (const llvm::APInt& token : inputs[i]) text += hex(token) + "\n";
    write_file(fmt::format("{}/port{}.hex", folder, i), text);
  }
  result.problem =
      run(fmt::format("cd {} && iverilog -g2005 -s testbench -o sim dut.v testbench.v && vvp -n sim", folder),
          folder + "/simulation.log");
  if (!result.problem.empty()) return result;
  std::istringstream log(read_file(folder + "/simulation.log"));
  for (std::string line; std::getline(log, line);) {
    if (line.rfind("PROBLEM", 0) == 0) result.problem = line;
    if (line.rfind("CLOCKS ", 0) == 0) result.clocks = std::strtoull(line.c_str() + 7, nullptr, 10);
  }
  result.outputs.resize(g.ports.size());
  for (std::size_t i = 0; i < g.ports.size(); ++i) {
    if (g.ports[i].input) continue;
    std::istringstream tokens(read_file(fmt::format("{}/port{}.out", folder, i)));
    for (std::string line; std::getline(tokens, line);) {
      if (line.find_first_of("xXzZ") != std::string::npos) {
        result.problem =
            fmt::format("port {}: unknown bits in token {}: {}", g.ports[i].name, result.outputs[i].size(), line);
        return result;
      }
      // APInt wants room for all digits of the text.
      result.outputs[i].push_back(
          llvm::APInt(static_cast<unsigned>(4 * line.size()) + 1, line, 16).zextOrTrunc(g.ports[i].width));
    }
  }
  return result;
}

interpretation interpret(const dataflow::graph& g, const std::vector<token_list>& inputs,
                         std::uint64_t most_iterations) {
  dataflow::interpreter machine(g);
  for (std::uint32_t i = 0; i < g.ports.size(); ++i) {
    for (const llvm::APInt& token : inputs[i]) machine.push(i, token);
  }
  interpretation result;
  result.complete = machine.run_until_blocked(most_iterations).last == dataflow::outcome::blocked;
  result.outputs.resize(g.ports.size());
  for (std::uint32_t i = 0; i < g.ports.size(); ++i) {
    if (g.ports[i].input) continue;
    while (auto token = machine.pop(i)) result.outputs[i].push_back(*token);
  }
  return result;
}

std::vector<token_list> random_inputs(const dataflow::graph& g, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<token_list> inputs(g.ports.size());
  for (std::size_t i = 0; i < g.ports.size(); ++i) {
    if (!g.ports[i].input) continue;
    for (std::size_t t = 0; t < count; ++t) {
      std::vector<std::uint64_t> words((g.ports[i].width + 63) / 64);
      for (std::uint64_t& word : words) word = random() >> (random() % 3 == 0 ? random() % 64 : 0);
      inputs[i].push_back(llvm::APInt(g.ports[i].width, llvm::ArrayRef<std::uint64_t>(words)));
    }
  }
  return inputs;
}

std::string lint(const dataflow::graph& g, const std::string& verilog, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::string file = fmt::format("{}/{}.v", folder, g.name);
  write_file(file, verilog);
  std::string words = run("verilator --lint-only -Wall " + file, folder + "/verilator.log");
  if (words.empty()) words = run("iverilog -g2005 -Wall -tnull " + file, folder + "/iverilog.log");
  if (words.empty()) words = read_file(folder + "/iverilog.log");
  if (words.empty()) {
    words = run(fmt::format("yosys -q -e latch -p 'read_verilog {}; hierarchy -check; proc; check -assert'", file),
                folder + "/yosys.log");
  }
  return words;
}

}  // namespace epiline::testing
