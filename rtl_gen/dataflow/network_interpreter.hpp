#pragma once
// Executes a network: its processes in turn, each with an interpreter of its own, joined by queues as deep as the FIFOs
// (and a word that waits for room, which every writer has). A circuit has more places than that, between the steps of
// its pipelines: so it deadlocks only where this does.

#include <cstdint>
#include <string>
#include <vector>

#include "dataflow/interpreter.hpp"
#include "dataflow/network.hpp"

namespace epiline::dataflow {

class network_interpreter {
 public:
  /// `n` need not outlive the call. Throws std::invalid_argument with find_violation's sentence, and like interpreter.
  explicit network_interpreter(const network& n);

  /// Attempts iterations of all processes until none can go on, or one has made `max_iterations` more. `iterations` of
  /// the result are those of the process that made most.
  interpreter::progress run_until_blocked(std::uint64_t max_iterations);

  /// As in interpreter, for the top's ports.
  void push(port_id port, const llvm::APInt& token);
  std::optional<llvm::APInt> pop(port_id port);
  [[nodiscard]] std::size_t available(port_id port) const;
  [[nodiscard]] port_id find_port(std::string_view name, bool input) const;

  /// Iterations since construction of the process that made most.
  [[nodiscard]] std::uint64_t iterations() const;

  /// Tokens now in a FIFO, and the most there were.
  [[nodiscard]] std::size_t fill(fifo_id id) const;
  [[nodiscard]] std::size_t peak(fifo_id id) const { return joints_[id].peak; }

  /// Why it does not go on: what each process waits for, by the names of the streams; of a single process what
  /// interpreter says.
  [[nodiscard]] std::string message() const;

 private:
  struct joint {  // a FIFO
    fifo what;
    endpoint writer, reader;
    std::size_t peak = 0;
  };
  struct call_field {  // a process's scalar in the top's call token
    unsigned low, width;
  };
  struct call_taker {
    endpoint at;
    std::vector<call_field> fields;  // low bits first
  };

  /// Moves what fits from the writers into the FIFOs. Returns whether something moved.
  bool move_tokens();
  /// The FIFO that keeps a process from going on, since the token it wrote last has no room; null: none does.
  [[nodiscard]] const joint* full_output(process_id process) const;

  std::vector<std::string> names_;  // of the processes
  std::vector<port> ports_;
  std::vector<interpreter> machines_;
  std::vector<joint> joints_;
  std::vector<endpoint> inside_;  // by port of the top; of the call port, the first taker's
  std::vector<call_taker> takers_;
  std::vector<outcome> last_;
};

}  // namespace epiline::dataflow
