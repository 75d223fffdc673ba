#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "check/files.hpp"
#include "check/graph_level.hpp"
#include "check/planted_fault.hpp"
#include "check/program.hpp"
#include "check/simulation.hpp"
#include "check/software.hpp"
#include "check/token_file.hpp"
#include "check/verdicts.hpp"
#include "dataflow/network_text.hpp"
#include "frontend/parameter_members.hpp"
#include "frontend/stream_arrays.hpp"
#include "frontend/tasks.hpp"

namespace epiline::check {

namespace fs = std::filesystem;

namespace {

/// Iterations of a graph, after which it counts as one that does not end.
constexpr std::uint64_t most_iterations = 5'000'000;
/// Clocks without a token after which a circuit counts as stuck: more than any pipeline is long.
constexpr std::uint64_t least_patience = 4000;

/// What a native run must not do, since it has no value in C++ either and hardware does something else.
const std::vector<std::string>& sanitizer_options() {
  static const std::vector<std::string> options = {
      "-fsanitize=bounds,shift-exponent,integer-divide-by-zero,signed-integer-overflow,return,unreachable,null",
      "-fno-sanitize-recover=all"};
  return options;
}

}  // namespace

const std::vector<std::string>& level_names() {
  static const std::vector<std::string> names = {"native-gcc",    "native-clang",    "ir-source", "ir-lowered",
                                                 "graph",         "passes",          "text",      "rtl-icarus",
                                                 "rtl-verilator", "random-schedule", "netlist"};
  return names;
}

struct checker::state {
  state(options given, frontend::source_options source, std::ostream& to)
      : wanted(std::move(given)), table(to), planted(wanted.fault) {
    top.source = std::move(source);
    wanted.folder = fs::absolute(wanted.folder);
  }

  /// "file:line: " of the write of the token that differs first.
  std::string first_place() {
    if (table.first_where().port == dataflow::none) return {};
    if (at_source.places.empty()) {
      // Only lowered IR tells from which of several lines a token comes, so it is run for that.
      std::string problem;
      const program built = build_lowered_ir(top, network, wanted.folder, at_iterations);
      if (built.problem.empty()) {
        const answer found = run(built, network, at_iterations.inputs, problem);
        if (problem.empty()) note_places(found);
      }
    }
    const auto& places = at_source.places;
    std::string place;
    if (table.first_where().port < places.size() && table.first_where().token < places[table.first_where().port].size())
      place = places[table.first_where().port][table.first_where().token];
    if (place.empty()) place = write_place(network, table.first_where().port);
    return place.empty() ? place : place + ": ";
  }

  bool wants(std::string_view level) const {
    return wanted.levels.empty() || std::ranges::find(wanted.levels, level) != wanted.levels.end();
  }

  void write(const std::string& name, const std::string& text) const { write_file(wanted.folder / name, text); }

  // ---- programs of this machine ---------------------------------------------------------------------------------
  struct native {
    const char* level;
    const char* compiler;
    const char* package;
    program built;
  };

  void build_natively() {
    for (native& one : natives) {
      const bool needed = one.compiler == std::string(EPILINE_CLANG) && wanted.stimulus.empty();
      if (!wants(one.level) && !needed && !(one.compiler == std::string(EPILINE_CLANG) && !wants("native-gcc")))
        continue;
      one.built.problem = missing_program(one.compiler, one.package);
      if (!one.built.problem.empty()) continue;
      const bool is_clang = one.compiler == std::string(EPILINE_CLANG);
      one.built = build_native(top, network, wanted.folder, is_clang ? "native_clang" : "native_gcc", one.compiler,
                               is_clang ? sanitizer_options() : std::vector<std::string>{});
      if (!one.built.problem.empty())
        throw cannot_check(
            fmt::format("{}: error: the kernel cannot be run natively: {}", top.source.source, one.built.problem));
    }
  }

  std::vector<token_list> find_stimulus() {
    if (!wanted.stimulus.empty()) {
      token_file given = read_token_file(wanted.stimulus, network);
      expected = given;
      for (dataflow::port_id id = 0; id < network.ports.size(); ++id)
        if (!network.ports[id].input) given.tokens[id].clear();
      return std::move(given.tokens);
    }
    const program& clang = natives[1].built;
    std::string problem = clang.problem;
    if (problem.empty()) {
      answer found = run_random(clang, network, wanted.seed, wanted.tokens, problem);
      if (problem.empty()) return std::move(found.made_up);
    }
    throw cannot_check(
        fmt::format("{}: error: no random stimulus: {}: give one with --stimulus FILE", top.source.source, problem));
  }

  /// What the stimulus file says came out of whole calls that read all of it.
  answer recorded_answer(const std::vector<token_list>& inputs) const {
    answer found;
    found.end = ending::boundary;
    for (dataflow::port_id id = 0; id < network.ports.size(); ++id) {
      const dataflow::port& port = network.ports[id];
      if (!port.input && !expected->given[id])
        throw cannot_check(
            fmt::format("{}: error: --recorded: the file says nothing of the output '{}'", wanted.stimulus, port.name));
      found.outputs.push_back(port.input ? token_list{} : expected->tokens[id]);
      found.reads.push_back(inputs[id].size());
      found.done.push_back(found.outputs.back().size());
    }
    return found;
  }

  void run_native() {
    if (wanted.recorded) {
      std::vector<token_list> inputs = find_stimulus();
      answer found = recorded_answer(inputs);
      return take_reference(std::move(found), std::move(inputs), "stimulus file");
    }
    build_natively();
    std::vector<token_list> inputs = find_stimulus();
    std::optional<answer> first;
    for (const native& one : natives) {
      if (one.built.file.empty()) {
        if (wants(one.level)) table.skip(one.level, one.built.problem);
        continue;
      }
      if (first && !wants(one.level)) continue;
      std::string problem;
      answer found = run(one.built, network, inputs, problem);
      if (!first) {
        if (!problem.empty())
          throw cannot_check(fmt::format("{}: error: the kernel cannot be run natively ({}): {}", top.source.source,
                                         one.compiler, problem));
        take_reference(std::move(found), inputs, one.level);
        first.emplace();
      } else if (!problem.empty()) {
        table.differ(one.level, problem);
      } else {
        check_answer(one.level, at_source, found.outputs, fmt::format("{} calls", found.calls));
      }
    }
    check_expected();
  }

  void take_reference(answer found, std::vector<token_list> inputs, const char* level) {
    std::size_t in = 0, given = 0, left = 0;
    for (dataflow::port_id id = 0; id < network.ports.size(); ++id) {
      if (!network.ports[id].input) {
        given += found.outputs[id].size();
        continue;
      }
      // What no call reads does not go in anywhere.
      left += inputs[id].size() - found.reads[id];
      inputs[id].resize(found.reads[id]);
      in += inputs[id].size();
    }
    at_source = make_reference(network, found, inputs, tolerance::none);
    at_iterations = make_reference(network, found, std::move(inputs), tolerance::iteration);
    table.ran(level,
              fmt::format("{} tokens in, {} out{}{}{}", in, given,
                          wanted.recorded ? "" : fmt::format(", {} call{}", found.calls, found.calls == 1 ? "" : "s"),
                          found.end == ending::blocked ? ", and the beginning of one more" : "",
                          left == 0 ? "" : fmt::format("; {} tokens of the stimulus are never read", left)));
    if (given == 0)
      throw cannot_check(
          fmt::format("{}: error: nothing comes out with this stimulus, so nothing can be compared: give "
                      "another one with --stimulus FILE{}",
                      top.source.source, wanted.stimulus.empty() ? ", or another --seed" : ""));
    token_file kept{at_source.inputs, std::vector<bool>(network.ports.size(), true)};
    for (dataflow::port_id id = 0; id < network.ports.size(); ++id)
      if (!network.ports[id].input) kept.tokens[id] = at_source.outputs[id];
    write("stimulus.tokens", to_text(kept, network));
  }

  /// A stimulus file may say what is to come out.
  void check_expected() {
    if (!expected || std::ranges::none_of(network.ports, [&](const dataflow::port& port) {
          return !port.input && expected->given[static_cast<std::size_t>(&port - network.ports.data())];
        }))
      return;
    std::vector<token_list> outputs = at_source.outputs;
    reference by_file = at_source;
    for (dataflow::port_id id = 0; id < network.ports.size(); ++id)
      if (!network.ports[id].input && expected->given[id]) {
        by_file.outputs[id] = expected->tokens[id];
        by_file.at_least[id] = expected->tokens[id].size();
      }
    const difference found = compare(network, by_file, outputs);
    // Its own sentence: here the native run is what is looked at.
    if (!found.text.empty()) {
      std::string text = found.text;
      for (std::size_t at = text.find(", native "); at != std::string::npos; at = text.find(", native ", at + 1))
        text.replace(at, 9, ", the stimulus file says ");
      table.differ("stimulus file", text, found);
    } else {
      table.equal("stimulus file", "what it expects");
    }
  }

  void check_answer(std::string_view level, const reference& with, const std::vector<token_list>& outputs,
                    const std::string& remark) {
    const difference found = compare(network, with, outputs);
    if (found.text.empty())
      table.equal(level, remark);
    else
      table.differ(level, found.text, found);
  }

  void run_ir() {
    if (wants("ir-source") && has_tasks) {
      table.skip("ir-source", "tasks run side by side, this level one call after another");
    } else if (wants("ir-source")) {
      top_parts parts = top;
      parts.source_ir = planted.text_of("ir-source", parts.source_ir);
      run_program_level("ir-source", build_source_ir(parts, network, wanted.folder), at_source);
    }
    if (wants("ir-lowered")) {
      top_parts parts = top;
      for (lowered_text& process : parts.processes) process.text = planted.text_of("ir-lowered", process.text);
      run_program_level("ir-lowered", build_lowered_ir(parts, network, wanted.folder, at_iterations), at_iterations);
    }
  }

  void run_program_level(const char* level, const program& built, const reference& with) {
    std::string problem = built.problem;
    answer found;
    if (problem.empty()) found = run(built, network, with.inputs, problem);
    if (!problem.empty()) return table.differ(level, problem);
    if (std::string_view(level) == "ir-lowered") note_places(found);
    check_answer(level, with, found.outputs, "");
  }

  /// Every token's line: lowered IR knows which of several writes of a stream it comes from.
  void note_places(const answer& found) {
    at_source.places.assign(network.ports.size(), {});
    for (dataflow::port_id id = 0; id < network.ports.size(); ++id) {
      if (network.ports[id].input) continue;
      const dataflow::endpoint end = dataflow::find_end(network, network.ports[id].name, false);
      const lowered_text& process = top.processes[end.process == dataflow::none ? 0 : end.process];
      for (const unsigned line : found.lines[id]) {
        const bool known = line != 0 && line <= process.writes.size() && process.writes[line - 1].line != 0;
        at_source.places[id].push_back(
            known ? fmt::format("{}:{}", process.writes[line - 1].file, process.writes[line - 1].line) : "");
      }
    }
  }

  // ---- graphs -----------------------------------------------------------------------------------------------------
  /// A network as a level has it: of a fault that is planted, one line of its text differs.
  dataflow::network with_fault(const std::string& level, const dataflow::network& n) {
    if (!planted.is_for(level)) return n;
    return dataflow::parse_network(planted.text_of(level, dataflow::print_design(n)));
  }

  void run_built_graph() {
    const graph_verdict found = run_graph(with_fault("graph", network), at_iterations, most_iterations);
    iterations = std::max<std::uint64_t>(found.iterations, 1);
    at_clocks = at_iterations;
    if (found.problem.empty()) {
      // From here on all levels perform the same iterations, so they give the same number of tokens.
      at_clocks.outputs = found.outputs;
      if (!at_iterations.may_give_more || !is_endless())
        at_clocks.may_give_more = false;
      else
        at_clocks.outputs = at_iterations.outputs;
      for (dataflow::port_id id = 0; id < network.ports.size(); ++id)
        at_clocks.at_least[id] = at_clocks.outputs[id].size();
    }
    if (!wants("graph")) return;
    if (found.problem.empty())
      table.equal("graph", fmt::format("{} iterations", found.iterations));
    else
      table.differ("graph", found.problem, found.where);
  }
  bool is_endless() const { return at_source.may_give_more; }

  void run_pass(std::size_t process, const std::string& pass, const dataflow::graph& after) {
    ++passes;
    if (pass_failed) return;
    dataflow::network changed = now;
    changed.processes[process] = after;
    now.processes[process] = after;
    const graph_verdict found = run_graph(with_fault("passes/" + pass, changed), at_clocks, 2 * iterations + 1000);
    if (found.problem.empty()) return;
    pass_failed = true;
    const std::string which = network.processes.size() == 1 ? "" : " in process '" + after.name + "'";
    table.differ("passes", fmt::format("after pass {} ({}){}: {}", passes, pass, which, found.problem), found.where);
  }

  // ---- circuits ---------------------------------------------------------------------------------------------------
  void simulate_level(const std::string& level, const std::string& name, simulator with,
                      std::vector<std::string> files) {
    const simulation_verdict found = simulate({.folder = wanted.folder,
                                               .name = name,
                                               .verilog = std::move(files),
                                               .with = with,
                                               .seed = wanted.seed,
                                               .patience = least_patience + std::min<std::uint64_t>(clocks, 1'000'000),
                                               .sees_fifos = level != "netlist"},
                                              network, at_clocks);
    // Of a random schedule other words wait for each other.
    if (level.starts_with("rtl-")) raise_peaks(peak_fills, found.peak_fills);
    if (found.problem.empty())
      table.equal(level, fmt::format("{} clocks, and with random pauses", found.clocks));
    else
      table.differ(level, found.problem, found.where);
  }

  /// The simulator for levels that name none.
  std::optional<simulator> any_simulator() const {
    for (const simulator one : {simulator::icarus, simulator::verilator})
      if (missing_for(one).empty()) return one;
    return std::nullopt;
  }

  void run_random_schedule(const std::string& text) {
    if (!wants("random-schedule")) return;
    const std::optional<simulator> with = any_simulator();
    if (!with) return table.skip("random-schedule", missing_for(simulator::icarus));
    write("random_schedule.v", planted.text_of("random-schedule", text));
    simulate_level("random-schedule", "random", *with, {"random_schedule.v"});
  }

  /// In Verilator: cells whose inputs are partly unknown have unknown outputs in Icarus, where the circuit's are not.
  void run_netlist() {
    if (!wants("netlist")) return;
    if (const std::string lacks = missing_for(simulator::verilator); !lacks.empty())
      return table.skip("netlist", lacks);
    if (const std::string lacks = missing_for_synthesis(); !lacks.empty()) return table.skip("netlist", lacks);
    std::vector<std::string> files{"netlist.v"};
    std::vector<std::string> cells;
    write("rtl.v", verilog);
    if (const std::string problem = synthesize(wanted.folder, "rtl.v", network.name, wanted.target, "netlist.v", cells);
        !problem.empty())
      return table.differ("netlist", problem);
    if (planted.is_for("netlist")) {
      std::ifstream in(wanted.folder / "netlist.v");
      write("netlist.v", planted.text_of("netlist", {std::istreambuf_iterator<char>(in), {}}));
    }
    files.insert(files.end(), cells.begin(), cells.end());
    simulate_level("netlist", "netlist", simulator::verilator, files);
  }

  options wanted;
  verdicts table;
  planted_fault planted;
  top_parts top;
  bool has_tasks = false;
  dataflow::network network;  // before the passes: its ports are those of all levels
  std::vector<native> natives = {{"native-gcc", "g++", "g++", {}}, {"native-clang", EPILINE_CLANG, "clang-19", {}}};
  std::optional<token_file> expected;
  // The native answer, for levels that stop where it does; that perform whole iterations; and that perform the graph's.
  reference at_source, at_iterations, at_clocks;
  std::uint64_t iterations = 1, clocks = 1;
  dataflow::network now;  // as the passes leave it
  std::size_t passes = 0;
  bool pass_failed = false;
  std::string verilog;
  std::vector<std::uint64_t> peak_fills;  // of the Verilog's FIFOs
};

checker::checker(options wanted, frontend::source_options source, std::ostream& out)
    : state_(std::make_unique<state>(std::move(wanted), std::move(source), out)) {
  for (const std::string& level : state_->wanted.levels) {
    if (std::ranges::find(level_names(), level) == level_names().end()) {
      std::string names;
      for (const std::string& name : level_names()) names += (names.empty() ? "" : ", ") + name;
      throw std::invalid_argument(fmt::format("--levels {}: there is no such level: there are {}", level, names));
    }
    std::string lacks;
    if (level == "native-gcc") lacks = missing_program("g++", "g++");
    if (level == "rtl-icarus") lacks = missing_for(simulator::icarus);
    if (level == "rtl-verilator") lacks = missing_for(simulator::verilator);
    if (level == "netlist") lacks = missing_for_synthesis() + missing_for(simulator::verilator);
    if (!lacks.empty()) throw std::invalid_argument(fmt::format("--levels {}: {}", level, lacks));
  }
  std::error_code failed;
  fs::create_directories(state_->wanted.folder, failed);
  if (failed)
    throw std::invalid_argument(
        fmt::format("{}: cannot be made: {}", state_->wanted.folder.string(), failed.message()));
}
checker::~checker() = default;

bool checker::wants(std::string_view level) const { return state_->wants(level); }

const std::vector<std::uint64_t>& checker::peak_fills() const { return state_->peak_fills; }

void checker::see_source(llvm::Module& module) {
  state_->top.members = frontend::parameter_members(module, state_->top.source.top);
  for (const auto& arrays : {frontend::stream_arrays(module), frontend::value_arrays(module)})
    for (const auto& [position, count] : arrays) state_->top.arrays[position] = static_cast<int>(count);
  for (const auto& [position, count] : frontend::data_arrays(module))
    state_->top.arrays[position] = -static_cast<int>(count);
  state_->has_tasks = frontend::has_tasks(module);
  if (wants("ir-source")) state_->top.source_ir = executable_source(module);
}

void checker::see_top(const frontend::split_top& top) { state_->top.parameters = top.top.parameters; }

void checker::see_process(const frontend::lowered_process& process) {
  state_->top.processes.push_back(executable_process(process, state_->top.processes.size()));
}

void checker::see_network(const dataflow::network& n) {
  state_->network = n;
  state_->now = n;
  state_->run_native();
  state_->run_ir();
  state_->run_built_graph();
}

void checker::see_pass(std::size_t process, std::string_view pass, const dataflow::graph& after) {
  if (wants("passes")) state_->run_pass(process, std::string(pass), after);
}

void checker::see_verilog(const dataflow::network& n, const std::string& verilog, unsigned interval) {
  state& s = *state_;
  s.verilog = verilog;
  s.clocks = s.iterations * interval;
  if (wants("passes") && !s.pass_failed) s.table.equal("passes", fmt::format("after each of {}", s.passes));
  if (wants("text")) {
    const std::string text = dataflow::print_design(n);
    try {
      const graph_verdict found =
          run_graph(dataflow::parse_network(s.planted.text_of("text", text)), s.at_clocks, 2 * s.iterations + 1000);
      if (found.problem.empty())
        s.table.equal("text", "");
      else
        s.table.differ("text", found.problem, found.where);
    } catch (const dataflow::text_error& error) {
      s.table.differ("text", error.what());
    }
  }
  for (const simulator one : {simulator::icarus, simulator::verilator}) {
    const bool is_icarus = one == simulator::icarus;
    const char* const level = is_icarus ? "rtl-icarus" : "rtl-verilator";
    if (!wants(level)) continue;
    if (const std::string lacks = missing_for(one); !lacks.empty()) {
      s.table.skip(level, lacks);
      continue;
    }
    const std::string file = is_icarus ? "icarus.v" : "verilator.v";
    s.write(file, s.planted.text_of(level, verilog));
    s.simulate_level(level, is_icarus ? "icarus" : "verilator", one, {file});
  }
}

void checker::see_random_schedule(const std::string& verilog) {
  if (wants("random-schedule")) state_->run_random_schedule(verilog);
}

std::string checker::finish() {
  state_->run_netlist();
  const verdicts& table = state_->table;
  if (const std::string lacks = state_->planted.missing(); !lacks.empty()) throw cannot_check(lacks);
  if (!table.first_level().empty())
    return fmt::format("{}error: level {} differs: {}", state_->first_place(), table.first_level(), table.first_text());
  state_->table.print_end();
  return {};
}

}  // namespace epiline::check
