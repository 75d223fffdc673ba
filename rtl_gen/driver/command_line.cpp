#include "driver/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string_view>

namespace epiline::driver {

namespace {

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

/// A top's name without its scopes.
std::string base_name(const std::string& top) { return top.substr(top.rfind(':') + 1); }

void check_tops(const command_line& given) {
  std::set<std::string> names;
  for (const std::string& top : given.tops) {
    check_top_name(top);
    if (!names.insert(base_name(top)).second)
      throw usage_error(fmt::format("--top {}: another top has this name, and so its folder: compile them apart", top));
  }
  if (given.tops.size() > 1 && !given.depfile.empty())
    throw usage_error("--depfile says what one Verilog file is made of: give one --top");
}

/// What the options of --check ask for, beside what it shares with a compilation.
void prepare_check(command_line& given) {
  check::options& wanted = given.check_options;
  if (!given.check) {
    if (!wanted.stimulus.empty() || !wanted.levels.empty())
      throw usage_error("--stimulus and --levels are options of --check: give --check too");
    if (wanted.recorded) throw usage_error("--recorded is an option of --check: give --check and --stimulus too");
    return;
  }
  if (wanted.recorded && wanted.stimulus.empty())
    throw usage_error("--recorded speaks of the file of --stimulus: give --stimulus too");
  if (given.axi_lite) throw usage_error("--check drives the call port: leave --axi-lite away");
  wanted.seed = given.seed;
  wanted.target = given.target;
}

/// CLI11's errors in the form of all the others.
std::string explain_wrong_options(const CLI::App*, const CLI::Error& wrong) {
  static const std::regex repeated("(-[^:]*): At Most 1 required but received ([0-9]+)");
  const std::string text = std::regex_replace(wrong.what(), repeated, "$1 is there $2 times: give it once");
  return fmt::format("error: {} (epiline-hls --help tells of all options)\n", text);
}

/// "6ns", "6.5", "166MHz" as a period in nanoseconds.
double parse_clock(const std::string& text) {
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

void check_interval(const std::string& interval) {
  const bool is_number = !interval.empty() && interval.find_first_not_of("0123456789") == std::string::npos;
  if (interval != "auto" && (!is_number || interval.size() > 3 || std::stoi(interval) == 0))
    throw usage_error(fmt::format("--ii {}: give a number from 1 to 999, or auto", interval));
}

void add_options(CLI::App& app, command_line& given, std::string& clock, bool explains) {
  app.add_option("source", given.source.source, "the C++ file that defines the top function")->required(!explains);
  app.add_option("--top", given.tops,
                 "the top function's name; of several, each is compiled into a folder of its name in that of -o")
      ->required(!explains)
      ->allow_extra_args(false);
  app.add_option("-o,--output", given.output,
                 "folder for NAME.v, NAME.graph, NAME.signals.json, report.json, report.txt and report.html")
      ->required(!explains);
  app.add_option("--target", given.target, "device whose delays and memories are assumed: ecp5, hx8k, generic")
      ->capture_default_str();
  app.add_option("--clock", clock,
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
  app.add_flag("--recorded", given.check_options.recorded,
               "the file of --stimulus tells all that whole calls read and write: nothing runs natively");
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
}

}  // namespace

std::optional<command_line> read_command_line(int argc, char** argv, int& exit_code) {
  command_line given;
  CLI::App app("Compiles a C++ function over hls::stream into Verilog.");
  app.name("epiline-hls");
  app.set_version_flag("--version", "epiline-hls " EPILINE_VERSION);
  // Explaining needs nothing of what compiling needs.
  const bool explains = std::any_of(argv + 1, argv + argc, [](std::string_view word) { return word == "--explain"; });
  std::string clock;
  add_options(app, given, clock, explains);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    exit_code = app.exit(end);
    return std::nullopt;
  }
  check_interval(given.interval);
  given.interval_is_given = app.count("--ii") != 0;
  given.period_is_given = !clock.empty();
  if (given.period_is_given) given.period = parse_clock(clock);
  check_tops(given);
  prepare_check(given);
  return given;
}

command_line for_top(command_line given, std::size_t number) {
  given.source.top = given.tops[number];
  if (given.tops.size() > 1) given.output = std::filesystem::path(given.output) / base_name(given.source.top);
  given.check_options.folder = std::filesystem::path(given.output) / "check";
  return given;
}

}  // namespace epiline::driver
