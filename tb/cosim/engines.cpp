#include "cosim/engines.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <vector>

#include "cosim/frame_tokens.hpp"
#include "cosim/stream_driver.hpp"
#include "csim/frame_beats.hpp"
#include "dataflow/network_interpreter.hpp"
#include "dataflow/network_text.hpp"

namespace epiline::cosim {
namespace {

class stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class model_engine : public eval::engine {
 public:
  model_engine(const eval::design_description& design, model_factory make_model)
      : pixels_per_beat_(design.pixels_per_beat), make_model_(std::move(make_model)) {}

  eval::match_result match(const eval::match_request& request, const eval::run_options& options) override {
    const stopwatch watch;
    try {
      const std::unique_ptr<rtl_model> model = make_model_(options.seed);
      const frame_tokens frames(model->ports(), pixels_per_beat_);
      const int width = request.left.width;
      const int height = request.left.height;
      drive_request drive_this;
      frames.append_frame(request, drive_this.inputs);
      drive_this.expected[frames.output()] = frames.output_tokens(width, height);

      drive_options how;
      how.seed = options.seed;
      how.progress = options.progress;
      for (const model_port& port : model->ports()) {
        how.stalls[port.name] = {port.input ? options.input_gap_percent : options.output_stall_percent, 1};
      }
      const drive_result driven = drive(*model, drive_this, how);
      eval::match_result result;
      result.map = frames.map_of(driven.outputs.at(frames.output()).tokens, 0, width, height);
      result.seconds = watch.seconds();
      result.cycles = driven.busy_clocks();
      return result;
    } catch (const drive_error& error) {
      throw eval::engine_error(error.what());
    } catch (const unsuitable_ports& error) {
      throw eval::engine_error(error.what());
    } catch (const csim::malformed_frame& error) {
      throw eval::engine_error(error.what());
    }
  }

 private:
  int pixels_per_beat_;
  model_factory make_model_;
};

/// The ports of a graph as those of the module made of it.
std::vector<model_port> ports_of(const dataflow::network& graph) {
  std::vector<model_port> ports;
  for (const dataflow::port& port : graph.ports) {
    model_port& made = ports.emplace_back();
    made.name = port.name;
    made.input = port.input;
    made.width = port.width;
    switch (port.kind) {
      case dataflow::port_kind::stream:
        made.kind = port_kind::stream;
        break;
      case dataflow::port_kind::call:
        made.kind = port_kind::call;
        break;
      case dataflow::port_kind::result:
        made.kind = port_kind::result;
        break;
    }
    for (const dataflow::field& field : port.fields) made.fields.push_back({field.signal, field.width, field.offset});
  }
  return ports;
}

llvm::APInt as_apint(std::span<const std::uint32_t> token, unsigned width) {
  std::vector<std::uint64_t> words((width + 63) / 64);
  for (std::size_t word = 0; word < words.size(); ++word) {
    words[word] = bits_at(token, static_cast<unsigned>(64 * word), 64);
  }
  return {width, static_cast<unsigned>(words.size()), words.data()};
}

class graph_engine final : public eval::engine {
 public:
  graph_engine(const eval::design_description& design, std::filesystem::path graph_file)
      : pixels_per_beat_(design.pixels_per_beat), graph_file_(std::move(graph_file)) {}

  eval::match_result match(const eval::match_request& request, const eval::run_options& options) override {
    try {
      const dataflow::network graph = read_graph();
      const stopwatch watch;
      eval::match_result result;
      result.map = interpret(graph, request, options);
      result.seconds = watch.seconds();
      return result;
    } catch (const dataflow::text_error& error) {
      throw eval::engine_error(fmt::format("{}: {}", graph_file_.string(), error.what()));
    } catch (const unsuitable_ports& error) {
      throw eval::engine_error(error.what());
    } catch (const csim::malformed_frame& error) {
      throw eval::engine_error(error.what());
    }
  }

 private:
  [[nodiscard]] dataflow::network read_graph() const {
    std::ifstream file(graph_file_);
    if (!file) throw eval::engine_error(fmt::format("cannot read the dataflow graph '{}'", graph_file_.string()));
    std::ostringstream text;
    text << file.rdbuf();
    return dataflow::parse_network(text.str());
  }

  [[nodiscard]] eval::disparity_map interpret(const dataflow::network& graph, const eval::match_request& request,
                                              const eval::run_options& options) const {
    // A chunk of iterations between two reports of progress.
    constexpr std::uint64_t chunk = 20'000;
    const frame_tokens frames(ports_of(graph), pixels_per_beat_);
    std::map<std::string, token_list> inputs;
    frames.append_frame(request, inputs);
    dataflow::network_interpreter machine(graph);
    for (const auto& [name, tokens] : inputs) {
      const dataflow::port_id port = machine.find_port(name, true);
      for (std::size_t index = 0; index < tokens.size(); ++index) {
        machine.push(port, as_apint(tokens[index], tokens.width()));
      }
    }
    const std::size_t expected = frames.output_tokens(request.left.width, request.left.height);
    const dataflow::port_id output = machine.find_port(frames.output(), false);
    // A frame takes little more than one iteration a beat; a graph that runs on without end is stopped.
    const std::uint64_t limit = 4 * expected + 1'000'000;
    while (machine.run_until_blocked(chunk).last == dataflow::outcome::advanced) {
      if (machine.iterations() > limit) {
        throw eval::engine_error(fmt::format("no end after {} iterations of the dataflow graph", machine.iterations()));
      }
      if (options.progress) {
        options.progress(std::min(1.0, static_cast<double>(machine.available(output)) / static_cast<double>(expected)));
      }
    }
    // The machine waits for the next call. Anything else is an error: its message names the port.
    for (const auto& [name, tokens] : inputs) {
      if (const std::size_t left = machine.available(machine.find_port(name, true)); left != 0) {
        throw eval::engine_error(fmt::format("input stream '{}' is left with {} of {} tokens unread; {}", name, left,
                                             tokens.size(), machine.message()));
      }
    }
    if (machine.available(output) != expected) {
      throw eval::engine_error(fmt::format("output stream '{}' got {} tokens, not {}; {}", frames.output(),
                                           machine.available(output), expected, machine.message()));
    }
    const unsigned width = graph.ports[output].width;
    token_list tokens(width);
    while (const std::optional<llvm::APInt> token = machine.pop(output)) {
      const std::span<std::uint32_t> words = tokens.append();
      for (unsigned low = 0; low < width; low += 32) {
        const unsigned count = std::min(32u, width - low);
        words[low / 32] = static_cast<std::uint32_t>(token->extractBitsAsZExtValue(count, low));
      }
    }
    return frames.map_of(tokens, 0, request.left.width, request.left.height);
  }

  int pixels_per_beat_;
  std::filesystem::path graph_file_;
};

class netlist_engine final : public eval::engine {
 public:
  netlist_engine(const eval::design_description& design, std::filesystem::path library, std::string build_command)
      : design_(design), library_(std::move(library)), build_command_(std::move(build_command)) {}

  eval::match_result match(const eval::match_request& request, const eval::run_options& options) override {
    std::optional<double> build_seconds;
    if (!std::filesystem::exists(library_)) {
      const stopwatch watch;
      const std::string log = library_.string() + ".log";
      if (std::system(fmt::format("{} >'{}' 2>&1", build_command_, log).c_str()) != 0) {
        throw eval::engine_error(
            fmt::format("the netlist's simulation model could not be built by '{}'; see {}", build_command_, log));
      }
      build_seconds = watch.seconds();
    }
    model_engine engine(design_, load());
    eval::match_result result = engine.match(request, options);
    result.build_seconds = build_seconds;
    return result;
  }

 private:
  /// The library stays loaded until the program ends.
  [[nodiscard]] model_factory load() const {
    void* handle = dlopen(library_.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = handle == nullptr ? nullptr : dlsym(handle, "epiline_make_model");
    if (symbol == nullptr) {
      throw eval::engine_error(fmt::format("cannot load the netlist's simulation model: {}", dlerror()));
    }
    const auto make = reinterpret_cast<rtl_model* (*)(std::uint64_t)>(symbol);
    return [make](std::uint64_t seed) { return std::unique_ptr<rtl_model>(make(seed)); };
  }

  const eval::design_description& design_;
  std::filesystem::path library_;
  std::string build_command_;
};

}  // namespace

std::unique_ptr<eval::engine> make_model_engine(const eval::design_description& design, model_factory make_model) {
  return std::make_unique<model_engine>(design, std::move(make_model));
}

std::unique_ptr<eval::engine> make_graph_engine(const eval::design_description& design,
                                                std::filesystem::path graph_file) {
  return std::make_unique<graph_engine>(design, std::move(graph_file));
}

std::unique_ptr<eval::engine> make_netlist_engine(const eval::design_description& design, std::filesystem::path library,
                                                  std::string build_command) {
  return std::make_unique<netlist_engine>(design, std::move(library), std::move(build_command));
}

}  // namespace epiline::cosim
