// epiline-hls: a C++ top function in, Verilog and reports out.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "crash_report.hpp"
#include "dataflow/network_text.hpp"
#include "emit/network_report.hpp"
#include "emit/network_verilog.hpp"
#include "emit/register_map.hpp"
#include "emit/report_page.hpp"
#include "emit/signals.hpp"
#include "frontend/frontend.hpp"
#include "frontend/reproducer.hpp"
#include "passes/foresee_reads.hpp"
#include "passes/pipeline.hpp"
#include "prove/fault.hpp"
#include "prove/session.hpp"
#include "schedule/balance_fifos.hpp"
#include "schedule/schedule.hpp"

namespace {

namespace fs = std::filesystem;
using namespace epiline;

struct command_line {
  frontend::source_options source;
  std::string target = "ecp5";
  std::string clock;  // empty: default_period, or the smallest possible when that is larger
  std::string interval = "1";
  std::string scheduler = "optimal";
  std::uint64_t seed = 1;
  std::string output;
  std::string depfile;
  std::string device_delays;         // a file; empty: those that are built in
  std::vector<std::string> explain;  // a signal, and the folder of the Verilog it stands in; empty: compile
  std::string crash;
  double prove_seconds = 10;  // for a pass
  bool prove = false;
  std::string prove_fault;  // the pass after which a graph is broken for its proof; empty: none
  bool axi_lite = false;
  bool quiet = false;
  bool check = false;
  check::options check_options;
};

/// Writes that a read-modify-write through a block RAM has in flight: they are forwarded.
constexpr unsigned block_memory_latency = 2;
constexpr double default_period = 6.0;  // nanoseconds

class usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "6ns", "6.5", "166MHz" as a period in nanoseconds.
double parse_clock(const std::string& text) {
  if (text.empty()) return default_period;
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const std::string unit = text.substr(end);
  if (unit == "MHz" && value > 0)
    value = 1000.0 / value;
  else if (!unit.empty() && unit != "ns")
    end = 0;
  if (end == 0 || !(value >= 0.5 && value <= 1000))
    throw usage_error(
        fmt::format("--clock {}: not a clock: give a period from 0.5ns to 1000ns, or a frequency like 150MHz", text));
  return value;
}

/// Files appear under their names only when all of them are written.
class output_folder {
 public:
  explicit output_folder(const std::string& path) : path_(path) {
    std::error_code failed;
    made_ = fs::create_directories(path_, failed);
    if (failed || !fs::is_directory(path_))
      throw usage_error(fmt::format("{}: cannot be made: {}: choose another folder with -o", path,
                                    failed ? failed.message() : "it is not a folder"));
  }
  ~output_folder() {
    std::error_code ignored;
    for (const fs::path& file : files_) fs::remove(temporary(file), ignored);
    if (made_) fs::remove(path_, ignored);  // which fails when something is in it
  }
  output_folder(const output_folder&) = delete;
  output_folder& operator=(const output_folder&) = delete;

  void write(const std::string& name, const std::string& text) { write_file(path_ / name, text); }

  void write_file(const fs::path& file, const std::string& text) {
    files_.push_back(file);
    std::ofstream out(temporary(file), std::ios::binary);
    out << text;
    out.flush();
    if (!out)
      throw usage_error(
          fmt::format("{}: cannot be written: is the folder writable and the disk not full?", file.string()));
  }

  void commit() {
    for (const fs::path& file : files_) fs::rename(temporary(file), file);
    files_.clear();
  }

 private:
  static fs::path temporary(const fs::path& file) { return file.string() + ".part"; }
  fs::path path_;
  bool made_ = false;
  std::vector<fs::path> files_;
};

/// The schedule that --schedule asks for.
schedule::result schedule_as_asked(const dataflow::graph& graph, const schedule::delay_model& model,
                                   const schedule::options& options, const command_line& given) {
  return given.scheduler == "random" ? schedule::make_random_schedule(graph, model, options, given.seed)
                                     : schedule::make_schedule(graph, model, options);
}

/// The schedule, at the smallest initiation interval allowed that is possible.
schedule::result find_schedule(const dataflow::graph& graph, const schedule::delay_model& model,
                               const command_line& given, double period, unsigned allowed_by_source) {
  schedule::options options;
  options.period = period;
  int largest = static_cast<int>(allowed_by_source);
  if (given.interval == "auto")
    largest = 64;
  else if (given.interval != "1")
    options.initiation_interval = largest = std::atoi(given.interval.c_str());
  for (;; ++options.initiation_interval) {
    try {
      return schedule_as_asked(graph, model, options, given);
    } catch (const schedule::infeasible& refusal) {
      if (options.initiation_interval < largest) continue;
      if (!given.clock.empty() || options.period != period || refusal.smallest_period() <= 0) throw;
      std::cerr << fmt::format(
          "note: {:.2f} ns cannot be reached; made for {:.2f} ns, the smallest period possible. The reason:\n{}\n",
          period, refusal.smallest_period(), refusal.what());
      options.period = refusal.smallest_period();
      --options.initiation_interval;
    }
  }
}

/// Schedules `graph`, and foresees its reads if that costs neither period nor clocks between iterations.
schedule::result schedule_process(dataflow::graph& graph, const schedule::delay_model& model, const command_line& given,
                                  double period, unsigned allowed_by_source) {
  schedule::result plain = find_schedule(graph, model, given, period, allowed_by_source);
  dataflow::graph foreseen = graph;
  if (!passes::foresee_reads(foreseen)) return plain;
  try {
    schedule::result found = schedule_as_asked(foreseen, model, {plain.period, plain.initiation_interval}, given);
    graph = std::move(foreseen);
    return found;
  } catch (const schedule::infeasible&) {
    return plain;
  }
}

std::string dependency_file(const std::string& target, const std::vector<std::string>& files) {
  std::string text = target + ":";
  for (const std::string& file : files) text += " \\\n  " + file;
  return text + "\n";
}

/// The files that the graphs name, as far as they can still be read.
std::map<std::string, std::string> read_sources(const dataflow::network& network) {
  std::map<std::string, std::string> sources;
  for (const dataflow::graph& graph : network.processes)
    for (const std::string& file : graph.files) {
      std::ifstream in(file, std::ios::binary);
      if (in) sources[file] = {std::istreambuf_iterator<char>(in), {}};
    }
  return sources;
}

/// Proves foresee_reads, which is tried while scheduling, on a graph as the pipeline leaves it.
void prove_foreseen_reads(dataflow::graph graph, prove::session& proofs, bool with_fault) {
  passes::number_objects(graph);
  dataflow::graph foreseen = graph;
  passes::foresee_reads(foreseen);
  proofs.pass_ran(graph.name, "foresee_reads", graph, with_fault ? prove::with_fault(foreseen) : foreseen);
}

/// Writes proof.json, whatever becomes of the rest; nothing else is written when a pass was refuted.
void write_proofs(const prove::session& proofs, output_folder& output) {
  output.write("proof.json", proofs.to_json().dump(2) + "\n");
  output.commit();
  if (!proofs.refuted()) return;
  throw usage_error(
      "a pass changed what the program does (see above, and proof.json): this is a mistake in the compiler or in its "
      "proofs; please report it with the source");
}

/// Verilog of a random legal schedule in place of each schedule, with the same period and interval.
std::string randomly_scheduled(const dataflow::network& network, const schedule::delay_model& model,
                               const std::vector<schedule::result>& schedules, std::uint64_t seed) {
  std::vector<schedule::result> others;
  for (std::size_t i = 0; i < schedules.size(); ++i)
    others.push_back(schedule::make_random_schedule(network.processes[i], model,
                                                    {schedules[i].period, schedules[i].initiation_interval}, seed + i));
  return emit::emit_network(network, model, others).text;
}

/// The levels below the graph, and the verdict.
void check_hardware(check::checker& checker, const dataflow::network& network, const schedule::delay_model& model,
                    const std::vector<schedule::result>& schedules, const std::string& verilog, std::uint64_t seed) {
  int interval = 1;
  for (const schedule::result& one : schedules) interval = std::max(interval, one.initiation_interval);
  checker.see_verilog(network, verilog, static_cast<unsigned>(interval));
  if (checker.wants("random-schedule"))
    checker.see_random_schedule(randomly_scheduled(network, model, schedules, seed));
  if (const std::string difference = checker.finish(); !difference.empty()) throw check::cannot_check(difference);
}

class stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The name becomes text of the program that is compiled, and the name of files.
void check_top_name(const std::string& top) {
  std::string_view rest = top.starts_with("::") ? std::string_view(top).substr(2) : top;
  for (;;) {
    const std::string_view part = rest.substr(0, rest.find("::"));
    const bool is_name =
        !part.empty() && std::isdigit(static_cast<unsigned char>(part.front())) == 0 &&
        std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    if (!is_name) throw usage_error(fmt::format("--top {}: not the name of a function: give name or scope::name", top));
    if (part.size() == rest.size()) return;
    rest.remove_prefix(part.size() + 2);
  }
}

/// The delays in which the clock is predicted.
std::optional<emit::device_delays> find_delays(const command_line& given) {
  if (given.device_delays.empty()) return emit::fitted_delays(given.target);
  std::ifstream in(given.device_delays, std::ios::binary);
  if (!in) throw usage_error(fmt::format("--device-delays {}: cannot be read", given.device_delays));
  try {
    return emit::read_device_delays({std::istreambuf_iterator<char>(in), {}});
  } catch (const std::invalid_argument& wrong) {
    throw usage_error(fmt::format("--device-delays {}: {}", given.device_delays, wrong.what()));
  }
}

void run(const command_line& given) {
  check_top_name(given.source.top);
  const double period = parse_clock(given.clock);
  const schedule::delay_model model(given.target);
  const std::optional<emit::device_delays> delays = find_delays(given);
  output_folder output(given.output);
  stopwatch watch;

  llvm::LLVMContext context;
  frontend::compiled_source source = frontend::compile(given.source, context);
  crash_on_purpose(given.crash);
  std::unique_ptr<check::checker> checker;
  if (given.check) checker = std::make_unique<check::checker>(given.check_options, given.source, std::cout);
  if (checker) checker->see_source(*source.module);
  frontend::split_top split = frontend::split_into_processes(source, given.source);
  for (const std::string& note : source.notes) std::cerr << note << '\n';
  if (given.axi_lite && split.processes.size() > 1)
    frontend::refuse(split.top.place,
                     fmt::format("--axi-lite: the top '{}' is made of processes (DATAFLOW), whose scalars cannot be in "
                                 "registers yet: leave the option away, and drive the call port",
                                 split.name));
  if (checker) checker->see_top(split);
  std::vector<frontend::lowered_process> lowered;
  std::vector<dataflow::graph> graphs;
  for (frontend::process_source& process : split.processes) {
    lowered.push_back(frontend::lower(process));
    if (checker) checker->see_process(lowered.back());
    graphs.push_back(frontend::build_graph(lowered.back(), process.name));
  }
  dataflow::network network = frontend::join_processes(split, lowered, std::move(graphs));
  if (checker) checker->see_network(network);
  const double frontend_seconds = watch.lap();

  std::vector<nlohmann::json> pass_logs;
  prove::session proofs({given.prove_seconds}, [](const std::string& line) { std::cout << line << std::endl; });
  for (dataflow::graph& graph : network.processes) {
    passes::pipeline_options options{.forwarded_writes = block_memory_latency,
                                     .multiplier_width = model.parameters().multiplier_width};
    if (given.prove || given.check)
      options.observer = [&](std::string_view pass, const dataflow::graph& before, const dataflow::graph& after) {
        if (given.prove)
          proofs.pass_ran(graph.name, pass, before, given.prove_fault == pass ? prove::with_fault(after) : after);
        if (checker) checker->see_pass(static_cast<std::size_t>(&graph - network.processes.data()), pass, after);
      };
    pass_logs.push_back(passes::to_json(passes::run_default_pipeline(graph, options)));
    if (given.prove) prove_foreseen_reads(graph, proofs, given.prove_fault == "foresee_reads");
  }
  if (given.prove) write_proofs(proofs, output);
  if (const std::string violation = dataflow::find_violation(network); !violation.empty())
    throw std::logic_error("the passes made an ill-formed graph: " + violation);
  const double pass_seconds = watch.lap();

  std::vector<schedule::result> schedules;
  for (std::size_t i = 0; i < network.processes.size(); ++i)
    schedules.push_back(schedule_process(network.processes[i], model, given, period, lowered[i].initiation_interval));
  std::vector<bool> may_grow;
  for (const frontend::internal_stream& stream : split.streams) may_grow.push_back(!stream.depth_given);
  schedule::balance_fifos(network, schedules, may_grow);
  const double schedule_seconds = watch.lap();

  const std::string& name = network.name;
  const nlohmann::json report = emit::make_network_report(network, model, schedules, pass_logs, given.axi_lite, delays);
  const emit::verilog_text verilog = emit::emit_network(network, model, schedules, {.axi_lite = given.axi_lite});
  output.write(name + ".v", verilog.text);
  output.write(name + ".signals.json", emit::signals_text(verilog.modules));
  output.write(name + ".graph", dataflow::print_design(network));
  output.write("report.json", report.dump(2) + "\n");
  output.write("report.txt", emit::network_report_text(report));
  output.write("report.html", emit::report_page(report, read_sources(network)));
  if (given.axi_lite) {
    const emit::register_map map = emit::make_register_map(network.processes.front());
    output.write(map.module() + ".h", emit::to_c_header(map));
    output.write(map.module() + ".json", emit::to_json(map).dump(2) + "\n");
    output.write(map.module() + ".md", emit::to_markdown(map));
  }
  if (!given.depfile.empty())
    output.write_file(given.depfile,
                      dependency_file((fs::path(given.output) / (name + ".v")).string(), source.dependencies));
  output.commit();
  if (checker) check_hardware(*checker, network, model, schedules, verilog.text, given.seed);
  if (given.quiet) return;
  for (std::size_t i = 0; i < schedules.size(); ++i)
    std::cout << fmt::format("{}: {} operations, {} stages at {:.2f} ns, one iteration every {} clock{}\n",
                             network.processes[i].name, network.processes[i].nodes.size(), schedules[i].depth,
                             schedules[i].period, schedules[i].initiation_interval,
                             schedules[i].initiation_interval == 1 ? "" : "s");
  std::cout << fmt::format(
      "  C++ to graph {:.1f} s, passes {:.1f} s, schedule {:.1f} s, Verilog and reports {:.1f} s\n"
      "  {}/{}.v, {}.graph, {}.signals.json, report.json, report.txt, report.html{}\n",
      frontend_seconds, pass_seconds, schedule_seconds, watch.lap(), given.output, name, name, name,
      given.axi_lite ? fmt::format(", {0}_registers.h, {0}_registers.json, {0}_registers.md", name) : "");
}

/// What the options of --check ask for, beside what it shares with a compilation.
void prepare_check(command_line& given) {
  check::options& wanted = given.check_options;
  if (!given.check) {
    if (!wanted.stimulus.empty() || !wanted.levels.empty())
      throw usage_error("--stimulus and --levels are options of --check: give --check too");
    return;
  }
  if (given.axi_lite) throw usage_error("--check drives the call port: leave --axi-lite away");
  wanted.folder = fs::path(given.output) / "check";
  wanted.seed = given.seed;
  wanted.target = given.target;
}

/// CLI11's errors in the form of all the others.
std::string explain_wrong_options(const CLI::App*, const CLI::Error& wrong) {
  static const std::regex repeated("(-[^:]*): At Most 1 required but received ([0-9]+)");
  const std::string text = std::regex_replace(wrong.what(), repeated, "$1 is there $2 times: give it once");
  return fmt::format("error: {} (epiline-hls --help tells of all options)\n", text);
}

}  // namespace

int main(int argc, char** argv) {
  watch_for_crashes(argc, argv);
  command_line given;
  given.source.on_preprocessed = [](const std::string& text) {
    keep_for_crash_report(frontend::standalone_source(text));
  };
  CLI::App app("Compiles a C++ function over hls::stream into Verilog.");
  app.name("epiline-hls");
  app.set_version_flag("--version", "epiline-hls " EPILINE_VERSION);
  // Explaining needs nothing of what compiling needs.
  const bool explains = std::any_of(argv + 1, argv + argc, [](std::string_view word) { return word == "--explain"; });
  app.add_option("source", given.source.source, "the C++ file that defines the top function")->required(!explains);
  app.add_option("--top", given.source.top, "the top function's name")->required(!explains);
  app.add_option("-o,--output", given.output,
                 "folder for NAME.v, NAME.graph, NAME.signals.json, report.json, report.txt and report.html")
      ->required(!explains);
  app.add_option("--target", given.target, "device whose delays and memories are assumed: ecp5, hx8k, generic")
      ->capture_default_str();
  app.add_option("--clock", given.clock,
                 "period (6ns) or frequency (150MHz) to reach; without it 6ns, or the smallest period possible");
  app.add_option("-I", given.source.includes, "folder to search for headers")->allow_extra_args(false);
  app.add_option("-D", given.source.definitions, "macro, NAME or NAME=VALUE")->allow_extra_args(false);
  app.add_option("--ii", given.interval,
                 "clocks from one iteration to the next: a number, or auto for the fewest possible")
      ->capture_default_str();
  app.add_option("--schedule", given.scheduler, "optimal, or random: any legal one, a test tool")
      ->check(CLI::IsMember({"optimal", "random"}))
      ->capture_default_str();
  app.add_option("--seed", given.seed, "of the random schedule, and of what is random in --check")
      ->capture_default_str();
  app.add_flag(
      "--axi-lite", given.axi_lite,
      "put the scalar arguments into registers behind an AXI4-Lite slave, with NAME_registers.h, .json and .md");
  app.add_flag("--prove", given.prove, "prove by an SMT solver that each pass keeps what the program does: proof.json");
  app.add_option("--prove-seconds", given.prove_seconds, "processor time for the proof of one pass")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--prove-fault", given.prove_fault)->group("");  // hidden: for the tests of --prove
  app.add_flag("--check", given.check,
               "run every form of the program, native to netlist, with one stimulus, and compare (docs/flow.md)");
  app.add_option("--stimulus", given.check_options.stimulus, "token file for --check; without it random tokens");
  app.add_option("--levels", given.check_options.levels,
                 "those that --check runs; without it all whose tools are there")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--tokens", given.check_options.tokens, "random tokens of a stream, or calls, for --check")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--fault", given.check_options.fault)->group("");  // hidden: for the tests of --check
  app.add_option("--depfile", given.depfile, "write the files read, as a Makefile rule, for build systems");
  app.add_option("--device-delays", given.device_delays,
                 "file of delays (scripts/delay_fit.py) in which the clock after place and route is predicted; without "
                 "it those built in for the target, if there are any");
  app.add_option("--crash", given.crash)->group("");  // hidden: for the tests of the crash report
  app.add_option("--explain", given.explain, "say which source lines a name in the Verilog of FOLDER comes from")
      ->type_name("SIGNAL FOLDER")
      ->expected(2);
  app.add_flag("-q,--quiet", given.quiet, "print nothing but problems");
  app.failure_message(explain_wrong_options);
  CLI11_PARSE(app, argc, argv);
  try {
    if (given.interval != "auto" &&
        (given.interval.find_first_not_of("0123456789") != std::string::npos || given.interval.empty() ||
         given.interval.size() > 3 || std::stoi(given.interval) == 0))
      throw usage_error(fmt::format("--ii {}: give a number from 1 to 999, or auto", given.interval));
    prepare_check(given);
    if (given.explain.empty())
      run(given);
    else
      std::cout << emit::explain_signal(given.explain[0], given.explain[1]);
    return 0;
  } catch (const emit::unknown_signal& refusal) {
    std::cerr << "error: " << refusal.what() << '\n';
  } catch (const frontend::refused& refusal) {
    std::cerr << refusal.what() << '\n';
  } catch (const schedule::infeasible& refusal) {
    const std::string text = refusal.what();  // "FILE:LINE: TEXT"
    const std::size_t place = text.find(": ");
    std::cerr << text.substr(0, place) << ": error" << text.substr(place) << '\n';
  } catch (const std::invalid_argument& refusal) {
    const std::string text = refusal.what();  // "FILE:LINE: error: TEXT", or a text about an option
    std::cerr << (text.find(": error: ") == std::string::npos ? "error: " : "") << text << '\n';
  } catch (const check::cannot_check& refusal) {
    std::cerr << refusal.what() << '\n';
  } catch (const usage_error& refusal) {
    std::cerr << "error: " << refusal.what() << '\n';
  } catch (const std::exception& failure) {
    report_crash(failure.what());
  }
  return 1;
}
