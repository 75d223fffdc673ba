#pragma once
// What epiline-hls was asked for.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "frontend/frontend.hpp"

namespace epiline::driver {

struct command_line {
  frontend::source_options source;
  std::vector<std::string> tops;
  std::string target = "ecp5";
  double period = 6;             // nanoseconds
  bool period_is_given = false;  // otherwise the smallest possible will do when that is larger
  std::string interval = "1";
  bool interval_is_given = false;  // otherwise more clocks will do when no period helps
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

/// The command line asks for something that cannot be; what() says what and what to do, without "error: ".
class usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the command line. Returns what was asked for; or, after --help, --version or a mistake that it has told, only
/// the exit code in `exit_code`. Throws usage_error for values that contradict each other or mean nothing.
[[nodiscard]] std::optional<command_line> read_command_line(int argc, char** argv, int& exit_code);

/// What was asked for, for one of its tops: of several each has a folder of its own.
[[nodiscard]] command_line for_top(command_line given, std::size_t number);

}  // namespace epiline::driver
