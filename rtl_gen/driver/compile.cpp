#include "driver/compile.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "dataflow/network_text.hpp"
#include "driver/choose_schedule.hpp"
#include "driver/crash_report.hpp"
#include "driver/messages.hpp"
#include "driver/output_folder.hpp"
#include "emit/network_report.hpp"
#include "emit/network_verilog.hpp"
#include "emit/register_map.hpp"
#include "emit/report_page.hpp"
#include "emit/signals.hpp"
#include "frontend/frontend.hpp"
#include "passes/foresee_reads.hpp"
#include "passes/pipeline.hpp"
#include "prove/fault.hpp"
#include "prove/session.hpp"
#include "schedule/balance_fifos.hpp"

namespace epiline::driver {

namespace {

/// Writes that a read-modify-write through a block RAM has in flight: they are forwarded.
constexpr unsigned block_memory_latency = 2;

/// Tells how long each part of the way takes.
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

/// What the tops of a compilation have in common.
struct common {
  explicit common(const command_line& given) : model(given.target), delays(find_delays(given)) {}
  schedule::delay_model model;
  std::optional<emit::device_delays> delays;
  llvm::LLVMContext context;
  frontend::compiled_source source;
  double seconds = 0;  // that clang took
};

/// The compilation of one top, from step to step.
class compilation {
 public:
  compilation(const command_line& given, common& shared)
      : given_(given), model_(shared.model), delays_(shared.delays), output_(given.output) {}

  void read_source(common& shared, std::size_t top) {
    frontend::compiled_source& source = shared.source;
    frontend::keep_top(*source.module, top);
    crash_on_purpose(given_.crash);
    dependencies_ = source.dependencies;
    if (given_.check) checker_ = std::make_unique<check::checker>(given_.check_options, given_.source, std::cout);
    if (checker_) checker_->see_source(*source.module);
    split_ = frontend::split_into_processes(source, given_.source);
    for (const std::string& note : source.notes) std::cerr << note << '\n';
    if (given_.axi_lite && split_.processes.size() > 1)
      frontend::refuse(split_.top.place,
                       fmt::format("--axi-lite: the top '{}' is made of processes (DATAFLOW), whose scalars cannot be "
                                   "in registers yet: leave the option away, and drive the call port",
                                   split_.name));
    if (checker_) checker_->see_top(split_);
    std::vector<dataflow::graph> graphs;
    for (frontend::process_source& process : split_.processes) {
      lowered_.push_back(frontend::lower(process));
      for (const std::string& note : lowered_.back().notes) std::cerr << note << '\n';
      if (checker_) checker_->see_process(lowered_.back());
      graphs.push_back(frontend::build_graph(lowered_.back(), process.name));
    }
    network_ = frontend::join_processes(split_, lowered_, std::move(graphs));
    if (checker_) checker_->see_network(network_);
    seconds_.source = shared.seconds + watch_.lap();
  }

  void run_passes() {
    prove::session proofs({given_.prove_seconds}, [](const std::string& line) { std::cout << line << std::endl; });
    for (std::size_t i = 0; i < network_.processes.size(); ++i) {
      dataflow::graph& graph = network_.processes[i];
      passes::pipeline_options options{.forwarded_writes = block_memory_latency,
                                       .multiplier_width = model_.parameters().multiplier_width};
      if (given_.prove || checker_)
        options.observer = [&](std::string_view pass, const dataflow::graph& before, const dataflow::graph& after) {
          if (given_.prove)
            proofs.pass_ran(graph.name, pass, before, given_.prove_fault == pass ? prove::with_fault(after) : after);
          if (checker_) checker_->see_pass(i, pass, after);
        };
      pass_logs_.push_back(passes::to_json(passes::run_default_pipeline(graph, options)));
      if (given_.prove) prove_foreseen_reads(graph, proofs, given_.prove_fault == "foresee_reads");
    }
    if (given_.prove) write_proofs(proofs);
    if (const std::string violation = dataflow::find_violation(network_); !violation.empty())
      throw std::logic_error("the passes made an ill-formed graph: " + violation);
    seconds_.passes = watch_.lap();
  }

  void make_schedules() {
    for (std::size_t i = 0; i < network_.processes.size(); ++i)
      schedules_.push_back(choose_schedule(network_.processes[i], model_, given_, lowered_[i].initiation_interval));
    std::vector<bool> may_grow;
    for (const frontend::internal_stream& stream : split_.streams) may_grow.push_back(!stream.depth_given);
    schedule::balance_fifos(network_, schedules_, may_grow);
    seconds_.schedule = watch_.lap();
  }

  void write_files() {
    const std::string& name = network_.name;
    report_ = emit::make_network_report(network_, model_, schedules_, pass_logs_, given_.axi_lite, delays_);
    emit::verilog_text verilog = emit::emit_network(network_, model_, schedules_, {.axi_lite = given_.axi_lite});
    output_.write(name + ".v", verilog.text);
    output_.write(name + ".signals.json", emit::signals_text(verilog.modules));
    output_.write(name + ".graph", dataflow::print_design(network_));
    write_reports();
    if (given_.axi_lite) {
      const emit::register_map map = emit::make_register_map(network_.processes.front());
      output_.write(map.module() + ".h", emit::to_c_header(map));
      output_.write(map.module() + ".json", emit::to_json(map).dump(2) + "\n");
      output_.write(map.module() + ".md", emit::to_markdown(map));
    }
    if (!given_.depfile.empty()) output_.write_file(given_.depfile, dependency_file());
    output_.commit();
    verilog_ = std::move(verilog.text);
  }

  /// The levels below the graph, and the verdict.
  void check_hardware() {
    if (!checker_) return;
    int interval = 1;
    for (const schedule::result& one : schedules_) interval = std::max(interval, one.initiation_interval);
    checker_->see_verilog(network_, verilog_, static_cast<unsigned>(interval));
    if (checker_->wants("random-schedule")) checker_->see_random_schedule(randomly_scheduled());
    if (const std::string difference = checker_->finish(); !difference.empty()) throw check::cannot_check(difference);
    if (checker_->peak_fills().empty()) return;  // the reports know all there is
    emit::add_peak_fills(report_, checker_->peak_fills());
    write_reports();
    output_.commit();
  }

  void tell() {
    for (std::size_t i = 0; i < schedules_.size(); ++i)
      std::cout << fmt::format("{}: {} operations, {} stages at {:.2f} ns, one iteration every {} clock{}\n",
                               network_.processes[i].name, network_.processes[i].nodes.size(), schedules_[i].depth,
                               schedules_[i].period, schedules_[i].initiation_interval,
                               schedules_[i].initiation_interval == 1 ? "" : "s");
    std::cout << fmt::format(
        "  C++ to graph {:.1f} s, passes {:.1f} s, schedule {:.1f} s, Verilog and reports {:.1f} s\n"
        "  {}/{}.v, {}.graph, {}.signals.json, report.json, report.txt, report.html{}\n",
        seconds_.source, seconds_.passes, seconds_.schedule, watch_.lap(), given_.output, network_.name, network_.name,
        network_.name,
        given_.axi_lite ? fmt::format(", {0}_registers.h, {0}_registers.json, {0}_registers.md", network_.name) : "");
  }

 private:
  /// Proves foresee_reads, which is tried while scheduling, on a graph as the pipeline leaves it.
  static void prove_foreseen_reads(dataflow::graph graph, prove::session& proofs, bool with_fault) {
    passes::number_objects(graph);
    dataflow::graph foreseen = graph;
    passes::foresee_reads(foreseen);
    proofs.pass_ran(graph.name, "foresee_reads", graph, with_fault ? prove::with_fault(foreseen) : foreseen);
  }

  /// Writes proof.json, whatever becomes of the rest; nothing else is written when a pass was refuted.
  void write_proofs(const prove::session& proofs) {
    output_.write("proof.json", proofs.to_json().dump(2) + "\n");
    output_.commit();
    if (!proofs.refuted()) return;
    throw usage_error(
        "a pass changed what the program does (see above, and proof.json): this is a mistake in the compiler or in its "
        "proofs; please report it with the source");
  }

  void write_reports() {
    output_.write("report.json", report_.dump(2) + "\n");
    output_.write("report.txt", emit::network_report_text(report_));
    output_.write("report.html", emit::report_page(report_, read_sources()));
  }

  /// The files that the graphs name, as far as they can still be read.
  [[nodiscard]] std::map<std::string, std::string> read_sources() const {
    std::map<std::string, std::string> sources;
    for (const dataflow::graph& graph : network_.processes)
      for (const std::string& file : graph.files) {
        std::ifstream in(file, std::ios::binary);
        if (in) sources[file] = {std::istreambuf_iterator<char>(in), {}};
      }
    return sources;
  }

  /// The files read, as a Makefile's rule for the Verilog.
  [[nodiscard]] std::string dependency_file() const {
    std::string text = (std::filesystem::path(given_.output) / (network_.name + ".v")).string() + ":";
    for (const std::string& file : dependencies_) text += " \\\n  " + file;
    return text + "\n";
  }

  /// Verilog of a random legal schedule in place of each schedule, with the same period and interval.
  [[nodiscard]] std::string randomly_scheduled() const {
    std::vector<schedule::result> others;
    for (std::size_t i = 0; i < schedules_.size(); ++i)
      others.push_back(schedule::make_random_schedule(
          network_.processes[i], model_, {schedules_[i].period, schedules_[i].initiation_interval}, given_.seed + i));
    return emit::emit_network(network_, model_, others).text;
  }

  const command_line& given_;
  const schedule::delay_model& model_;
  const std::optional<emit::device_delays>& delays_;
  output_folder output_;
  stopwatch watch_;
  struct {
    double source = 0, passes = 0, schedule = 0;
  } seconds_;

  frontend::split_top split_;
  std::vector<frontend::lowered_process> lowered_;
  std::vector<std::string> dependencies_;  // the files read
  std::unique_ptr<check::checker> checker_;

  dataflow::network network_;
  std::vector<nlohmann::json> pass_logs_;  // by process, as the schedules
  std::vector<schedule::result> schedules_;
  std::string verilog_;
  nlohmann::json report_;
};

void compile_top(const command_line& given, common& shared, std::size_t top) {
  compilation one(given, shared);
  one.read_source(shared, top);
  one.run_passes();
  one.make_schedules();
  one.write_files();
  one.check_hardware();
  if (!given.quiet) one.tell();
}

/// Runs `work` in a process of its own, which begins with all that is in memory now: an error in it leaves the others
/// alone. Returns its exit code.
int run_apart(const std::function<int()>& work) {
  std::cout.flush();
  const pid_t child = ::fork();
  if (child < 0) throw usage_error("no process can be started: are there too many, or is the memory used up?");
  if (child == 0) {
    crash_report_of_this_process();
    const int code = work();
    std::cout.flush();
    ::_exit(code);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

int compile(const command_line& given) {
  // Never destroyed: that would be a lot of work for nothing.
  static common& shared = *new common(given);
  stopwatch watch;
  shared.source = frontend::compile(given.source, given.tops, shared.context);
  shared.seconds = watch.lap();
  if (given.tops.size() == 1) {
    compile_top(for_top(given, 0), shared, 0);
    return 0;
  }
  for (const std::string& note : shared.source.notes) std::cerr << note << '\n';
  shared.source.notes.clear();
  int worst = 0;
  for (std::size_t top = 0; top < given.tops.size(); ++top)
    worst = std::max(worst, run_apart([&] {
                       return with_messages([&] {
                         compile_top(for_top(given, top), shared, top);
                         return 0;
                       });
                     }));
  return worst;
}

}  // namespace epiline::driver
