#pragma once
// Where the names in the Verilog come from: NAME.signals.json beside NAME.v, and the answers of --explain.

#include <stdexcept>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/interface.hpp"

namespace epiline::emit {

/// One name of the module that others are made of by suffixes (x_s3, x_copy1, x_q ...).
struct signal {
  std::string name;
  std::string kind;  // "value", "register", "memory", "table", "delay line", "port", "port signal" or "control"
  std::string what;  // a value's operation; what a port's or a control signal is for
  unsigned width = 0;
  int stage = -1;                                // where it is computed or read; -1: it belongs to no stage
  std::vector<dataflow::source_location> where;  // its own line first, then those of what is part of its expression
};

/// What every module has: clock, reset, its own name, the signals of its ports.
[[nodiscard]] std::vector<signal> interface_signals(const std::string& module, const std::vector<rtl_port>& ports);

/// The names of one module of a Verilog file.
struct module_signals {
  std::string module;
  std::vector<std::string> files;  // which the signals' places count
  std::vector<signal> signals;
};

/// The text of NAME.signals.json, schema "epiline-signals/1". The same for the same input.
[[nodiscard]] std::string signals_text(const std::vector<module_signals>& modules);

class unknown_signal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the name `wanted`, which stands in a Verilog file of `folder`, is and which source lines it comes from: several
/// lines for a person. Names as tools print them are understood too: with a path of instances before, or a bit behind.
/// Throws `unknown_signal`, with the nearest names, when no file has such a name; std::invalid_argument when `folder`
/// holds nothing that epiline-hls wrote.
[[nodiscard]] std::string explain_signal(const std::string& wanted, const std::string& folder);

}  // namespace epiline::emit
