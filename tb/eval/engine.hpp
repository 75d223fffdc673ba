#pragma once
// What every engine (golden, native, graph, rtl, netlist, board) offers: one stereo pair in, one disparity map out.
// An engine is made for one design by a factory in the registry; the `epiline` command and the tests know engines only
// through this header.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "eval/designs.hpp"
#include "eval/frame.hpp"

namespace epiline::eval {

/// One frame to match. check_request() holds for every request an engine is given.
struct match_request {
  rgb_image left;
  rgb_image right;
  int levels = 0;               // 1 .. design.max_levels
  parameter_values parameters;  // every parameter of the design, each within its range
};

/// How to run, without influence on the map (an engine to which an entry means nothing ignores it).
struct run_options {
  std::uint64_t seed = 1;            // of random gaps and back-pressure
  int input_gap_percent = 0;         // 0..95: chance a clock that an input withholds its beat, each input on its own
  int output_stall_percent = 0;      // 0..95: chance a clock that the output is not ready
  std::string port;                  // of the board: a serial port
  int baud = 3'000'000;              // its rate, bits/s
  int patience_milliseconds = 5000;  // how long a board may say nothing
  /// Called now and then with the share done, 0..1; empty: nobody wants to know.
  std::function<void(double)> progress;
};

struct match_result {
  disparity_map map;
  double seconds = 0;                   // of the engine's own work, file input and output not counted
  std::optional<std::uint64_t> cycles;  // clocks from the first input beat to the last output beat; rtl and netlist
  std::optional<double> build_seconds;  // of a simulation model built for this run
  std::string note;                     // a line for people about how it went; may be empty
};

/// Everything that went wrong in words for the user: what, where, and what to do.
class engine_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class engine {
 public:
  engine() = default;
  engine(const engine&) = delete;
  engine& operator=(const engine&) = delete;
  virtual ~engine() = default;

  /// Throws engine_error when the frame cannot be computed (a tool is missing, a stream is left with unread tokens, a
  /// deadlock, ...).
  [[nodiscard]] virtual match_result match(const match_request& request, const run_options& options) = 0;
};

using engine_factory = std::function<std::unique_ptr<engine>(const design_description&)>;

/// Engines by (design, engine name). Filled by the register_*_engines functions of the folders that have engines, never
/// by static initialisation, which a linker may drop.
class engine_registry {
 public:
  struct entry {
    std::string design;
    std::string name;
    std::string meaning;  // one line for --list
    engine_factory make;
  };

  /// Throws std::logic_error when the pair (design, name) is there already or the design is unknown.
  void add(entry new_entry);

  /// Null when there is none.
  [[nodiscard]] const entry* find(std::string_view design, std::string_view name) const;

  /// In the order of registration.
  [[nodiscard]] std::vector<const entry*> engines_of(std::string_view design) const;

 private:
  std::vector<entry> entries_;
};

/// Throws engine_error unless levels and parameters are known and in range.
void check_settings(const design_description& design, const match_request& request);

/// check_settings(), and throws engine_error unless the two images agree in size and fit the design.
void check_request(const design_description& design, const match_request& request);

}  // namespace epiline::eval
