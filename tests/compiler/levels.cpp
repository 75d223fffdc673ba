#include "levels.hpp"

#include <fmt/format.h>
#include <llvm/ADT/ArrayRef.h>

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

#include "cosim/stream_driver.hpp"
#include "dataflow/network_interpreter.hpp"

namespace epiline::compiler_test {
namespace {

constexpr std::uint64_t most_iterations = 200'000;
/// Clocks a pipeline may take to fill and drain, and a first call to start, beside the clocks of its iterations.
constexpr std::uint64_t latency_allowance = 400;

const char* name_of(cosim::port_kind kind) {
  switch (kind) {
    case cosim::port_kind::stream:
      return "stream";
    case cosim::port_kind::call:
      return "call";
    case cosim::port_kind::result:
      return "result";
    case cosim::port_kind::axi_lite:
      return "axi_lite";
  }
  return "";
}

/// The recorded port that belongs to a level's port: the call port by its kind, all others by name too.
template <class Port>
const recorded_port& find_recorded(const std::vector<recorded_port>& recorded, const Port& port) {
  const std::string kind = name_of(port.kind);
  for (const recorded_port& candidate : recorded) {
    if (candidate.kind == kind && candidate.input == port.input && (kind == "call" || candidate.name == port.name)) {
      return candidate;
    }
  }
  throw std::runtime_error(
      fmt::format("port '{}' ({} {}) is not in C++", port.name, port.input ? "input" : "output", kind));
}

template <class Ports>
void check_count(const Ports& ports, const std::vector<recorded_port>& recorded) {
  if (ports.size() == recorded.size()) return;
  for (const recorded_port& port : recorded) {
    const bool there = std::ranges::any_of(ports, [&](const auto& candidate) {
      return name_of(candidate.kind) == port.kind && (port.kind == "call" || candidate.name == port.name);
    });
    if (!there) throw std::runtime_error(fmt::format("no port '{}'", port.name));
  }
}

std::vector<placed_field> places(const dataflow::port& port) {
  std::vector<placed_field> result;
  for (const dataflow::field& field : port.fields) result.push_back({field.signal, field.width, field.offset});
  return result;
}

std::vector<placed_field> places(const cosim::model_port& port) {
  std::vector<placed_field> result;
  for (const cosim::model_field& field : port.fields) result.push_back({field.name, field.width, field.offset});
  return result;
}

llvm::APInt to_integer(std::span<const std::uint32_t> token, unsigned width) {
  std::vector<std::uint64_t> words((width + 63) / 64);
  for (std::size_t i = 0; i < token.size(); ++i) words[i / 2] |= std::uint64_t{token[i]} << (32 * (i % 2));
  return {width, llvm::ArrayRef<std::uint64_t>(words)};
}

void append(cosim::token_list& list, const llvm::APInt& value) {
  const std::span<std::uint32_t> token = list.append();
  for (std::size_t i = 0; i < token.size(); ++i) {
    token[i] = static_cast<std::uint32_t>(value.getRawData()[i / 2] >> (32 * (i % 2)));
  }
}

graph_verdict run_graph(const dataflow::network& design, const std::vector<recorded_port>& recorded) {
  graph_verdict verdict;
  const auto leads_backwards = [&](const dataflow::fifo& fifo) {
    return dataflow::find_end(design, fifo.name, false).process > dataflow::find_end(design, fifo.name, true).process;
  };
  verdict.waits =
      std::ranges::any_of(design.processes, [](const dataflow::graph& g) { return g.patient != dataflow::none; }) ||
      std::ranges::any_of(design.fifos, leads_backwards);
  check_count(design.ports, recorded);
  dataflow::network_interpreter engine(design);
  for (dataflow::port_id id = 0; id < design.ports.size(); ++id) {
    const dataflow::port& port = design.ports[id];
    if (!port.input) continue;
    const cosim::token_list tokens = lay_out(find_recorded(recorded, port), places(port), port.width);
    for (std::size_t i = 0; i < tokens.size(); ++i) engine.push(id, to_integer(tokens[i], port.width));
  }
  const dataflow::interpreter::progress progress = engine.run_until_blocked(most_iterations);
  verdict.iterations = progress.iterations;
  for (dataflow::port_id id = 0; id < design.ports.size(); ++id) {
    const dataflow::port& port = design.ports[id];
    if (port.input) {
      if (engine.available(id) > 0 && verdict.difference.empty()) {
        verdict.difference = fmt::format("input '{}': {} tokens left unread", port.name, engine.available(id));
      }
      continue;
    }
    const cosim::token_list wanted = lay_out(find_recorded(recorded, port), places(port), port.width);
    cosim::token_list found(port.width);
    while (const std::optional<llvm::APInt> token = engine.pop(id)) append(found, *token);
    const std::string difference = compare(port.name, places(port), found, wanted);
    if (!difference.empty()) verdict.difference = difference;  // wrong tokens say more than unread ones
  }
  if (progress.last == dataflow::outcome::broken_promise) verdict.difference = engine.message();
  if (progress.last == dataflow::outcome::advanced && verdict.difference.empty()) {
    verdict.difference = fmt::format("still running after {} iterations", most_iterations);
  }
  if (progress.last == dataflow::outcome::blocked && !verdict.difference.empty()) {
    verdict.difference += fmt::format(" ({})", engine.message());
  }
  return verdict;
}

struct pause_pattern {
  const char* name;
  bool random;  // every port draws its own share of {0, 25, 50, 90} %
  int percent;
  unsigned burst;
  bool ready_after_valid;
  bool probe_outputs;
};
constexpr std::array patterns = {
    pause_pattern{"no pauses", false, 0, 1, false, false},
    pause_pattern{"50 % pauses everywhere", false, 50, 1, false, true},
    pause_pattern{"random pauses", true, 0, 8, false, false},
    pause_pattern{"random pauses, ready after valid", true, 0, 40, true, false},
};

std::string run_rtl(const std::function<std::unique_ptr<cosim::rtl_model>()>& make,
                    const std::vector<recorded_port>& recorded, std::uint64_t seed, std::uint64_t clocks) {
  std::unique_ptr<cosim::rtl_model> model = make();
  check_count(model->ports(), recorded);
  cosim::drive_request request;
  const std::vector<cosim::model_port> ports = model->ports();
  std::vector<std::pair<const cosim::model_port*, cosim::token_list>> wanted;
  for (const cosim::model_port& port : ports) {
    cosim::token_list tokens = lay_out(find_recorded(recorded, port), places(port), port.width);
    if (port.input) {
      request.inputs.emplace(port.name, std::move(tokens));
    } else {
      request.expected.emplace(port.name, tokens.size());
      wanted.emplace_back(&port, std::move(tokens));
    }
  }
  std::mt19937_64 random(seed);
  for (const pause_pattern& pattern : patterns) {
    cosim::drive_options options;
    options.seed = seed;
    options.patience = 4000;
    options.quiet_clocks = 150;
    options.ready_after_valid = pattern.ready_after_valid;
    options.probe_outputs = pattern.probe_outputs;
    for (const cosim::model_port& port : ports) {
      static constexpr std::array shares = {0, 25, 50, 90};
      options.stalls[port.name] = {pattern.random ? shares[random() % shares.size()] : pattern.percent, pattern.burst};
    }
    if (&pattern != &patterns.front()) model = make();
    try {
      const cosim::drive_result result = cosim::drive(*model, request, options);
      for (const auto& [port, tokens] : wanted) {
        const std::string difference = compare(port->name, places(*port), result.outputs.at(port->name).tokens, tokens);
        if (!difference.empty()) return fmt::format("{}, seed {}: {}", pattern.name, seed, difference);
      }
      if (&pattern == &patterns.front() && clocks > 0 && result.busy_clocks() > clocks + latency_allowance) {
        return fmt::format("{} clocks, {} expected", result.busy_clocks(), clocks);
      }
    } catch (const cosim::drive_error& error) {
      return fmt::format("{}: {}", pattern.name, error.what());
    }
  }
  return {};
}

}  // namespace

graph_verdict check_graph(const dataflow::network& design, const std::vector<recorded_port>& recorded) {
  try {
    return run_graph(design, recorded);
  } catch (const std::exception& error) {
    return {error.what(), 0, false};
  }
}

std::string check_rtl(const std::function<std::unique_ptr<cosim::rtl_model>()>& make,
                      const std::vector<recorded_port>& recorded, std::uint64_t seed, std::uint64_t clocks) {
  try {
    return run_rtl(make, recorded, seed, clocks);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace epiline::compiler_test
