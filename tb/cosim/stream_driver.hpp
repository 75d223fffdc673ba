#pragma once
// Drives a module through its AXI4-Stream ports: sources with random gaps, sinks with random back-pressure, and a check
// of the handshake rules at every clock.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "cosim/model.hpp"
#include "cosim/token_list.hpp"

namespace epiline::cosim {

/// When a port pauses: a source withholds its next token, a sink is not ready.
struct stall_profile {
  int percent = 0;     // 0..99: share of the clocks it wants to pause
  unsigned burst = 1;  // every decision holds for 1..burst clocks, drawn evenly
};

struct drive_options {
  std::uint64_t seed = 1;
  std::map<std::string, stall_profile> stalls;  // by port name; a port that is not named never pauses
  /// A sink is ready only when it has seen tvalid. A module that waits for tready before it raises tvalid deadlocks.
  bool ready_after_valid = false;
  /// At every clock, look at tvalid and payload of each output with tready 0 and 1: neither may depend on it.
  bool probe_outputs = false;
  /// Clocks without any token moved, after which nothing more is expected to happen.
  std::uint64_t patience = 20000;
  /// Clocks watched for surplus tokens after the last expected one.
  std::uint64_t quiet_clocks = 1000;
  /// Called about every 100,000 clocks with the share of the input tokens accepted, 0..1; may be empty.
  std::function<void(double)> progress;
};

/// What passed through one port. `clocks[i]` is the clock (0 = the first after reset) in which token i was accepted.
struct port_record {
  token_list tokens;
  std::vector<std::uint64_t> clocks;
};

struct drive_result {
  std::map<std::string, port_record> outputs;
  /// Without the tokens themselves.
  std::map<std::string, port_record> inputs;
  /// The most tokens in each FIFO between processes, by the stream's name.
  std::map<std::string, unsigned> peak_fills;
  std::uint64_t clocks = 0;  // simulated in all

  /// Clocks from the first token accepted at any input to the last token at any output, both counted; 0 when nothing
  /// moved.
  [[nodiscard]] std::uint64_t busy_clocks() const;
};

struct drive_request {
  /// By name of an input port; an input port that is not named gets no token.
  std::map<std::string, token_list> inputs;
  /// Tokens each output port is to send; from a port that is not named any number is taken.
  std::map<std::string, std::size_t> expected;
  /// Asked before input `port` offers its token `index`, with what has passed so far; false: not yet. This is how ports
  /// that have to do with each other (a parameter's write, and the frame it is for) keep their order. May be empty.
  std::function<bool(const std::string& port, std::size_t index, const drive_result& so_far)> may_offer = {};
};

/// The module, or the request, is wrong. what() names the port, the clock and the seed.
class drive_error : public std::runtime_error {
 public:
  enum class reason {
    bad_request,     // a port that is not there, or tokens of another width
    rule_violation,  // AXI4-Stream: tvalid withdrawn, payload changed while waiting, output depends on tready
    deadlock,        // tokens still expected, and none moved for `patience` clocks
    unread_tokens,   // every expected output came, but inputs were not read to the end
    surplus_tokens,  // more output tokens than expected
  };
  drive_error(reason why, const std::string& message) : std::runtime_error(message), why_(why) {}
  [[nodiscard]] reason why() const { return why_; }

 private:
  reason why_;
};

/// Resets the module, plays the request and returns when every input token was accepted and every expected output
/// token has arrived (outputs without an expected count: when nothing moved for `patience` clocks).
/// Throws drive_error.
[[nodiscard]] drive_result drive(rtl_model& model, const drive_request& request, const drive_options& options);

}  // namespace epiline::cosim
