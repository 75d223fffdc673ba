#pragma once
// epiline-hls --check: one stimulus through every form that a kernel takes on its way to a netlist.
//
// The compiler shows each form to a `checker` when it has it; the checker runs it, compares what comes out with the
// native run, and prints a line. Levels, in this order:
//   native-gcc, native-clang   the source, in a driver
//   ir-source, ir-lowered      LLVM IR as clang gives it, and as the frontend leaves it
//   graph, passes, text        the dataflow graph, after each pass, and read back from its text
//   rtl-icarus, rtl-verilator  the Verilog under random pauses
//   random-schedule            Verilog of a random legal schedule
//   netlist                    what Yosys makes of the Verilog for --target

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dataflow/network.hpp"
#include "frontend/lower.hpp"
#include "frontend/processes.hpp"

namespace epiline::check {

/// The names of all levels in their order.
[[nodiscard]] const std::vector<std::string>& level_names();

struct options {
  std::filesystem::path folder;     // everything that is made stands in it
  std::string stimulus;             // a token file; empty: random tokens
  bool recorded = false;            // it tells all that whole calls read and write: no native run
  std::vector<std::string> levels;  // empty: all whose tools are there
  std::uint64_t seed = 1;           // of random tokens and pauses
  std::uint64_t tokens = 200;       // random ones of a stream, or calls
  std::string target = "ecp5";
  std::string fault;  // "LEVEL:FROM:TO": for tests: the level's text is changed before it runs; of passes "passes/NAME"
};

/// What the levels are compared with cannot be had: the kernel does not run natively, or the stimulus is wrong. what()
/// is the whole message.
class cannot_check : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class checker {
 public:
  /// Throws std::invalid_argument for levels that are not known or whose tools are missing.
  checker(options wanted, frontend::source_options source, std::ostream& out);
  ~checker();
  checker(const checker&) = delete;
  checker& operator=(const checker&) = delete;

  // In this order:
  void see_source(llvm::Module& module);
  void see_top(const frontend::split_top& top);
  void see_process(const frontend::lowered_process& process);  // of each, before it becomes a graph
  /// Before the passes. Throws cannot_check.
  void see_network(const dataflow::network& n);
  void see_pass(std::size_t process, std::string_view pass, const dataflow::graph& after);
  /// After them. `interval`: most clocks an iteration takes.
  void see_verilog(const dataflow::network& n, const std::string& verilog, unsigned interval);
  void see_random_schedule(const std::string& verilog);
  /// Prints the end of the table. Returns an empty string when all levels that ran are equal, or one message that names
  /// the first that is not, and the first value.
  [[nodiscard]] std::string finish();

  /// By FIFO of the network, the most tokens it held in the simulations of the Verilog; empty: none was simulated.
  [[nodiscard]] const std::vector<std::uint64_t>& peak_fills() const;

  /// Whether a level is to be run: work that is for it only can be saved.
  [[nodiscard]] bool wants(std::string_view level) const;

 private:
  struct state;
  std::unique_ptr<state> state_;
};

}  // namespace epiline::check
