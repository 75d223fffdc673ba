#pragma once
// Levels that are Verilog, simulated: in Icarus Verilog or in Verilator, under several patterns of random pauses.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "check/answer.hpp"
#include "dataflow/network.hpp"

namespace epiline::check {

enum class simulator { icarus, verilator };

struct simulation_request {
  std::filesystem::path folder;      // where everything is made
  std::string name;                  // of this simulation's files in it
  std::vector<std::string> verilog;  // files, in the folder or with their full paths
  simulator with = simulator::icarus;
  std::uint64_t seed = 1;
  std::uint64_t patience = 4000;  // clocks without a token that moves
  bool sees_fifos = false;        // the Verilog is as it was generated
};

struct simulation_verdict {
  std::string problem;       // empty: equal
  difference where;          // the token that differs, if that is the problem
  std::uint64_t clocks = 0;  // without pauses
  /// By FIFO, the most tokens it held under any pattern of pauses; empty: not seen.
  std::vector<std::uint64_t> peak_fills;
};

/// Of each FIFO the larger of two peak fills; `peaks` may be empty.
void raise_peaks(std::vector<std::uint64_t>& peaks, const std::vector<std::uint64_t>& others);

/// Whether the simulator's programs are installed: empty, or what is missing and its Debian package.
[[nodiscard]] std::string missing_for(simulator which);

[[nodiscard]] simulation_verdict simulate(const simulation_request& request, const dataflow::network& n,
                                          const reference& wanted);

/// Synthesizes `verilog`, a file in `folder`, into `netlist` there, for a device of --target. Returns an empty string
/// or what went wrong. `cells` gets the files with the netlist's cells.
[[nodiscard]] std::string synthesize(const std::filesystem::path& folder, const std::string& verilog,
                                     const std::string& top, const std::string& target, const std::string& netlist,
                                     std::vector<std::string>& cells);
[[nodiscard]] std::string missing_for_synthesis();

}  // namespace epiline::check
