#include "check/software.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "check/files.hpp"
#include "check/program.hpp"

namespace epiline::check {

namespace fs = std::filesystem;

namespace {

constexpr unsigned build_seconds = 300;
constexpr unsigned run_seconds = 120;
/// Tokens of an output, beyond those wanted, after which a run without end is stopped.
constexpr std::size_t surplus_tokens = 100;

/// Where a parameter of the top is among the network's ports.
struct parameter_place {
  dataflow::port_id port = dataflow::none;
  unsigned offset = 0, width = 0;  // of a scalar in the call's token; of others 0 and the port's width
};

parameter_place place_of(const dataflow::network& n, const std::string& name) {
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id) {
    const dataflow::port& port = n.ports[id];
    if (port.kind != dataflow::port_kind::call) {
      if (port.name == name) return {id, 0, port.width};
      continue;
    }
    for (const dataflow::field& field : port.fields)
      if (field.name == name) return {id, field.offset, field.width};
  }
  throw std::logic_error(fmt::format("parameter '{}' is no port", name));
}

int call_port(const dataflow::network& n) {
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
    if (n.ports[id].kind == dataflow::port_kind::call) return static_cast<int>(id);
  return -1;
}

std::string native_source(const top_parts& top, const dataflow::network& n) {
  std::string text = fmt::format(
      "// Written by epiline-hls --check.\n#include <epiline/check_driver.hpp>\n"
      "#define main epiline_main_of_the_source\n#include \"{}\"\n#undef main\n\nnamespace epiline::check {{\n",
      fs::absolute(top.source.source).lexically_normal().string());
  std::string table;
  for (std::size_t i = 0; i < top.members.size(); ++i) {
    text += fmt::format(
        "template <>\nstruct members<{}> {{\n  template <class V, class F>\n  static void visit(V& v, F&& f) {{ {} "
        "}}\n}};\n",
        i, *top.members[i]);
    const parameter_place at = place_of(n, top.parameters.at(static_cast<unsigned>(i)));
    const dataflow::port& port = n.ports[at.port];
    const char* const role = port.kind == dataflow::port_kind::call     ? "scalar"
                             : port.kind == dataflow::port_kind::result ? "result"
                             : port.input                               ? "input"
                                                                        : "output";
    table += fmt::format("      {{epiline::check::role::{}, {}, {}}},\n", role, at.port, at.width);
  }
  std::string counts;  // of elements, for each parameter up to the last array
  const unsigned positions = top.arrays.empty() ? 0 : top.arrays.rbegin()->first + 1;
  for (unsigned position = 0; position < positions; ++position) {
    const auto array = top.arrays.find(position);
    counts += fmt::format(", {}", array == top.arrays.end() ? 0 : array->second);
  }
  text += fmt::format(
      "}}\n\nint main(int argc, char** argv) {{\n  epiline::check::drive<&::{0}{2}>(&::{0}, {{\n{1}  }}, argc, "
      "argv);\n}}\n",
      top.source.top, table, counts);
  return text;
}

/// The user's options as the frontend passes them.
void add_source_options(std::vector<std::string>& words, const top_parts& top) {
  words.insert(words.end(), {"-I", EPILINE_TYPES_DIRECTORY, "-I", EPILINE_CHECK_INCLUDES});
  for (const std::string& path : top.source.includes) words.insert(words.end(), {"-I", fs::absolute(path).string()});
  words.insert(words.end(), {"-I", EPILINE_TYPES_DIRECTORY "/.."});
  for (const std::string& definition : top.source.definitions) words.push_back("-D" + definition);
}

program build(const std::vector<std::string>& words, const fs::path& folder, const std::string& name) {
  const std::string log = name + ".log";
  const program_end end = run_program(words, folder, log, build_seconds);
  if (end == program_end::timed_out) return {{}, fmt::format("{} takes more than {} s", words[0], build_seconds)};
  if (end == program_end::failed)
    return {{},
            fmt::format("{} does not compile it: {}", fs::path(words[0]).filename().string(),
                        what_went_wrong(folder / log))};
  return {folder / name, {}};
}

program build_ir(const fs::path& folder, const std::string& name, const std::string& main,
                 const std::vector<std::string>& texts) {
  write_file(folder / (name + ".cpp"), main);
  // Without optimisation: it is these instructions that are to be run.
  std::vector<std::string> words{*find_program(EPILINE_CLANG), "-std=c++17", "-w", "-O0", "-I",
                                 EPILINE_CHECK_INCLUDES,       name + ".cpp"};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::string file = fmt::format("{}_{}.ll", name, i);
    write_file(folder / file, texts[i]);
    words.push_back(file);
  }
  words.insert(words.end(), {"-o", name});
  return build(words, folder, name);
}

/// Where the port of a process leads, as C++.
std::string port_end(const dataflow::network& n, const dataflow::port& port) {
  if (port.kind == dataflow::port_kind::call) {
    std::string fields;
    for (const dataflow::field& field : port.fields) {
      const parameter_place at = place_of(n, field.name);
      fields += fmt::format("{{{}, {}}}, ", at.offset, at.width);
    }
    return fmt::format("{{port_end::call, {}, {{{}}}}}", call_port(n), fields);
  }
  for (std::size_t i = 0; i < n.fifos.size(); ++i)
    if (n.fifos[i].name == port.name) return fmt::format("{{port_end::fifo, {}}}", i);
  return fmt::format("{{port_end::top_port, {}}}", place_of(n, port.name).port);
}

std::uint64_t number(std::istream& words) {
  std::uint64_t value = 0;
  words >> value;
  return value;
}

answer read_answer(const fs::path& file, const dataflow::network& n) {
  answer result;
  for (auto* lists : {&result.outputs, &result.made_up}) lists->resize(n.ports.size());
  result.lines.resize(n.ports.size());
  result.done.resize(n.ports.size());
  result.reads.resize(n.ports.size());
  std::ifstream in(file);
  bool is_complete = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string what, text;
    words >> what;
    if (what == "end") {
      words >> text;
      const auto found = std::ranges::find(ending_names, text);
      is_complete = found != std::end(ending_names);
      result.end = static_cast<ending>(found - std::begin(ending_names));
    } else if (what == "calls") {
      result.calls = number(words);
    } else {
      const std::uint64_t port = number(words);
      if (port >= n.ports.size()) throw std::runtime_error("the program's answer names a port that is not there");
      if (what == "read") result.reads[port] = number(words);
      if (what == "done") result.done[port] = number(words);
      if (what != "out" && what != "in") continue;
      words >> text;
      std::optional<llvm::APInt> token = from_hexadecimal(text, n.ports[port].width);
      if (!token)
        throw std::runtime_error(
            fmt::format("'{}' is no token of the {} bits of port '{}'", text, n.ports[port].width, n.ports[port].name));
      (what == "out" ? result.outputs : result.made_up)[port].push_back(std::move(*token));
      if (what == "out") result.lines[port].push_back(static_cast<unsigned>(number(words)));
    }
  }
  if (!is_complete) throw std::runtime_error("the program ended before its end");
  return result;
}

answer run_words(const program& what, const dataflow::network& n, const std::vector<std::string>& arguments,
                 std::string& problem) {
  const fs::path folder = what.file.parent_path();
  const std::string name = what.file.filename().string();
  fs::remove(folder / (name + ".out"));
  std::vector<std::string> words{what.file.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.push_back(name + ".out");
  const program_end end = run_program(words, folder, name + "_run.log", run_seconds);
  if (end == program_end::timed_out)
    problem = fmt::format("it runs for more than {} s", run_seconds);
  else if (end == program_end::failed)
    problem = "it stops: " + what_went_wrong(folder / (name + "_run.log"));
  else
    return read_answer(folder / (name + ".out"), n);
  return {};
}

}  // namespace

program build_native(const top_parts& top, const dataflow::network& n, const fs::path& folder, const std::string& name,
                     const std::string& compiler, const std::vector<std::string>& options) {
  for (std::size_t i = 0; i < top.members.size(); ++i)
    if (!top.members[i])
      return {{},
              fmt::format("parameter '{}' has bit-fields, or a type without members that are known: the tokens of "
                          "a native run cannot be made",
                          top.parameters.at(static_cast<unsigned>(i)))};
  write_file(folder / (name + ".cpp"), native_source(top, n));
  // Tokens are made of all members, private ones too.
  std::vector<std::string> words{*find_program(compiler), "-std=c++17", "-w", "-O0", "-fno-access-control"};
  words.insert(words.end(), options.begin(), options.end());
  add_source_options(words, top);
  words.insert(words.end(), {name + ".cpp", "-o", name});
  return build(words, folder, name);
}

program build_source_ir(const top_parts& top, const dataflow::network& n, const fs::path& folder) {
  std::string table, inputs;
  for (const auto& [index, name] : top.parameters) {
    const parameter_place at = place_of(n, name);
    table += fmt::format("{{{}, {}}}, ", at.port, at.offset);
  }
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
    if (n.ports[id].input) inputs += fmt::format("{}, ", id);
  return build_ir(folder, "ir_source",
                  fmt::format("// Written by epiline-hls --check.\n#include <epiline/check_ir.hpp>\n"
                              "extern \"C\" void epiline_top_for_ever();\n"
                              "int main(int, char** argv) {{\n"
                              "  epiline::check::source_run run({{{}}}, {}, {{{}}}, argv);\n"
                              "  epiline::check::source_run::current() = &run;\n  epiline_top_for_ever();\n}}\n",
                              table, call_port(n), inputs),
                  {top.source_ir});
}

program build_lowered_ir(const top_parts& top, const dataflow::network& n, const fs::path& folder,
                         const reference& wanted) {
  std::string functions, processes, depths, limits;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < top.processes.size(); ++i) {
    functions += fmt::format("extern \"C\" void {}();\n", process_function(i));
    std::string ports;
    for (const dataflow::port& port : n.processes[i].ports) ports += port_end(n, port) + ", ";
    processes += fmt::format("{{{}, {{{}}}}}, ", process_function(i), ports);
    texts.push_back(top.processes[i].text);
  }
  for (const dataflow::fifo& f : n.fifos) depths += fmt::format("{}, ", f.depth);
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
    if (!n.ports[id].input)
      limits += fmt::format("{{{}, {}}}, ", id, wanted.may_give_more ? wanted.outputs[id].size() + surplus_tokens : 0);
  return build_ir(folder, "ir_lowered",
                  fmt::format("// Written by epiline-hls --check.\n#include <epiline/check_ir.hpp>\n{}"
                              "int main(int, char** argv) {{\n  using namespace epiline::check;\n"
                              "  lowered_run({{{}}}, {{{}}}, {{{}}}, argv).run();\n}}\n",
                              functions, processes, depths, limits),
                  texts);
}

answer run(const program& what, const dataflow::network& n, const std::vector<token_list>& inputs,
           std::string& problem) {
  std::string text;
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
    for (const llvm::APInt& token : inputs[id]) text += fmt::format("{} {}\n", id, to_hexadecimal(token));
  const std::string name = what.file.filename().string() + ".in";
  write_file(what.file.parent_path() / name, text);
  return run_words(what, n, {name}, problem);
}

answer run_random(const program& what, const dataflow::network& n, std::uint64_t seed, std::uint64_t tokens,
                  std::string& problem) {
  return run_words(what, n, {"random", std::to_string(seed), std::to_string(tokens)}, problem);
}

}  // namespace epiline::check
