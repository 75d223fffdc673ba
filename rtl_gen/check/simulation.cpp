#include "check/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "check/bench.hpp"
#include "check/files.hpp"
#include "check/program.hpp"

namespace epiline::check {

namespace fs = std::filesystem;

namespace {

constexpr unsigned most_seconds = 600;

constexpr const char* verilator_main = R"(// Written by epiline-hls --check.
#include <cstdlib>
#include <cstring>

#include "Vbench.h"
#include "verilated.h"

int main(int argc, char** argv) {
  VerilatedContext context;
  context.commandArgs(argc, argv);
  context.randReset(2);  // what is not reset starts with random values
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], "+seed=", 6) == 0) context.randSeed(std::atoi(argv[i] + 6));
  Vbench bench(&context);
  while (!context.gotFinish()) {
    bench.clk = 0;
    bench.eval();
    bench.clk = 1;
    bench.eval();
  }
  bench.final();
  return 0;
}
)";

/// Makes the program of a simulation; returns the words that run it, or throws what went wrong.
std::vector<std::string> build(const simulation_request& request, const std::string& bench) {
  const std::string log = request.name + ".log";
  std::vector<std::string> words, run;
  if (request.with == simulator::icarus) {
    words = {*find_program("iverilog"), "-g2005", "-s", "epiline_check_clock", "-o", request.name + ".vvp", bench};
    run = {*find_program("vvp"), "-n", request.name + ".vvp"};
  } else {
    write_file(request.folder / (request.name + "_main.cpp"), verilator_main);
    fs::remove_all(request.folder / (request.name + ".model"));
    // Verilator's own library is the same for all.
    const std::string cache = find_program("ccache") ? " OBJCACHE=ccache" : "";
    words = {*find_program("verilator"), "--cc", "--exe", "--build", "--quiet-exit", "--no-timing",
             // This optimisation of Verilator 5.006 gave wrong values for gates of a netlist (matrix_vector, generic).
             "-fno-dfg", "--x-assign", "unique", "--x-initial", "unique", "--noassert", "--output-split", "15000",
             "-Wno-fatal", "-Wno-lint", "-Wno-style", "-Wno-MODDUP", "--top-module", "epiline_check_bench", "--prefix",
             "Vbench", "-MAKEFLAGS", "OPT_FAST=-O1 OPT_SLOW=-O0 OPT_GLOBAL=-O1 VM_PARALLEL_BUILDS=1" + cache, "--Mdir",
             request.name + ".model", "-o", "bench", bench, request.name + "_main.cpp"};
    run = {(request.folder / (request.name + ".model") / "bench").string()};
  }
  words.insert(words.end(), request.verilog.begin(), request.verilog.end());
  const program_end end = run_program(words, request.folder, log, most_seconds);
  if (end == program_end::timed_out)
    throw std::runtime_error(fmt::format("{} takes more than {} s", words.front(), most_seconds));
  if (end == program_end::failed)
    throw std::runtime_error(fmt::format("{} refuses the Verilog: {}", fs::path(words.front()).filename().string(),
                                         what_went_wrong(request.folder / log)));
  return run;
}

}  // namespace

void raise_peaks(std::vector<std::uint64_t>& peaks, const std::vector<std::uint64_t>& others) {
  peaks.resize(others.size());
  for (std::size_t i = 0; i < others.size(); ++i) peaks[i] = std::max(peaks[i], others[i]);
}

std::string missing_for(simulator which) {
  if (which == simulator::verilator) return missing_program("verilator", "verilator");
  return missing_program("iverilog", "iverilog");
}

simulation_verdict simulate(const simulation_request& request, const dataflow::network& n, const reference& wanted) {
  simulation_verdict verdict;
  try {
    const std::string bench = request.name + "_bench.v";
    write_file(request.folder / bench, bench_text(n, wanted, request.patience, request.sees_fifos));
    write_inputs(request.folder, n, wanted);
    std::vector<std::string> run = build(request, bench);
    for (unsigned pattern = 0; pattern < bench_patterns; ++pattern) {
      const std::string out = fmt::format("{}_{}.out", request.name, pattern);
      const std::string log = fmt::format("{}_{}.log", request.name, pattern);
      fs::remove(request.folder / out);
      std::vector<std::string> words = run;
      words.insert(words.end(), {fmt::format("+pattern={}", pattern), fmt::format("+seed={}", request.seed % 1'000'000),
                                 "+out=" + out});
      const program_end end = run_program(words, request.folder, log, most_seconds);
      if (end == program_end::timed_out)
        throw std::runtime_error(fmt::format("the simulation takes more than {} s", most_seconds));
      if (end == program_end::failed)
        throw std::runtime_error("the simulation failed: " + what_went_wrong(request.folder / log));
      const bench_answer answer = read_bench_answer(request.folder / out, n);
      if (pattern == 0) verdict.clocks = answer.clocks;
      raise_peaks(verdict.peak_fills, answer.peak_fills);
      verdict.problem = answer.problem;
      if (verdict.problem.empty()) {
        verdict.where = compare(n, wanted, answer.outputs);
        verdict.problem = verdict.where.text;
      }
      if (!verdict.problem.empty()) {
        verdict.problem += fmt::format(" ({})", pattern_name(pattern));
        return verdict;
      }
    }
  } catch (const std::runtime_error& error) {
    verdict.problem = error.what();
  }
  return verdict;
}

std::string missing_for_synthesis() {
  if (const std::string lacks = missing_program("yosys", "yosys"); !lacks.empty()) return lacks;
  if (!fs::exists(EPILINE_SYNTHESIS_SCRIPT)) return fmt::format("{} is not there", EPILINE_SYNTHESIS_SCRIPT);
  return missing_program("python3", "python3");
}

std::string synthesize(const fs::path& folder, const std::string& verilog, const std::string& top,
                       const std::string& target, const std::string& netlist, std::vector<std::string>& cells) {
  std::vector<std::string> words;
  std::string made = netlist;
  if (target == "generic") {
    // Gates and flip-flops; memories stay arrays, which no device has as flip-flops either.
    words = {*find_program("yosys"),
             "-Q",
             "-T",
             "-q",
             "-p",
             fmt::format(
                 "read_verilog {}; synth -top {} -run begin:fine; opt -fast -full; memory_share; opt -undriven -fine; "
                 "techmap; opt -fast; abc -fast; opt -fast; clean; check -assert; write_verilog -noattr {}",
                 verilog, top, netlist)};
  } else {
    made = fmt::format("synthesis/{}_netlist.v", top);
    words = {EPILINE_SYNTHESIS_SCRIPT,
             (folder / verilog).string(),
             top,
             "-o",
             (folder / "synthesis").string(),
             "--target",
             target};
    cells = {target == "hx8k" ? EPILINE_CELLS "/ice40_cells.v" : EPILINE_CELLS "/ecp5_cells.v"};
  }
  const program_end end = run_program(words, folder, "synthesis.log", most_seconds);
  if (end == program_end::timed_out) return fmt::format("Yosys takes more than {} s", most_seconds);
  if (end == program_end::failed) return what_went_wrong(folder / "synthesis.log");
  if (made != netlist) fs::copy_file(folder / made, folder / netlist, fs::copy_options::overwrite_existing);
  return {};
}

}  // namespace epiline::check
