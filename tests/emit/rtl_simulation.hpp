#pragma once
// Runs emitted Verilog in Icarus under random gaps and back-pressure, and the same tokens through the interpreter.

#include <llvm/ADT/APInt.h>

#include <cstdint>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::testing {

/// Tokens of one port, in order.
using token_list = std::vector<llvm::APInt>;

struct simulation_options {
  unsigned gap_percent = 0;  // clocks in which an input has no token, or an output's ready is 0
  std::uint64_t seed = 1;
  unsigned idle_clocks = 400;    // the simulation ends after so many clocks without a transfer
  unsigned most_clocks = 40000;  // or after so many in all: a graph need not wait for anything
};

struct simulation_result {
  std::vector<token_list> outputs;  // per port; empty for inputs
  std::uint64_t clocks = 0;         // from the first accepted input to the last output
  std::string problem;              // what went wrong, empty if nothing did: tool errors, AXI4-Stream rules
};

/// `inputs` has one list a port (empty for outputs). `folder` is created; it keeps the Verilog and the tools' output.
[[nodiscard]] simulation_result simulate(const dataflow::graph& g, const std::string& verilog,
                                         const std::vector<token_list>& inputs, const std::string& folder,
                                         const simulation_options& options);

struct interpretation {
  std::vector<token_list> outputs;  // per port
  bool complete = false;            // it came to wait for a token: nothing follows these outputs
};

/// What the interpreter makes of the same inputs in up to `most_iterations`.
[[nodiscard]] interpretation interpret(const dataflow::graph& g, const std::vector<token_list>& inputs,
                                       std::uint64_t most_iterations = 10000);

/// Random tokens for every input port.
[[nodiscard]] std::vector<token_list> random_inputs(const dataflow::graph& g, std::size_t count, std::uint64_t seed);

/// Verilator's lint with all warnings, Icarus, and Yosys' check; empty when all are content, else the tools' words.
[[nodiscard]] std::string lint(const dataflow::graph& g, const std::string& verilog, const std::string& folder);

/// A fresh folder below the system's temporary one.
[[nodiscard]] std::string scratch_folder(const std::string& name);

/// Runs a shell command; returns its output when it fails, empty text when it succeeds.
[[nodiscard]] std::string run(const std::string& command, const std::string& log);

}  // namespace epiline::testing
