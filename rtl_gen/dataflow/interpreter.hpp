#pragma once
// Executes a dataflow graph, iteration by iteration, bit by bit as graph.hpp defines it: the reference every pass and
// every generated circuit is compared with, and an engine fast enough for whole frames.
//
// The constructor translates the graph into batches of equal instructions (translate.hpp; no dispatch a node); a value
// of up to 64 bits is one 64-bit word, a wider one several words, low word first.
//
// Where graph.hpp leaves a value open: unspecified values are 0; a memory read past the end gives 0 and a write past
// the end does nothing; when `distance` is 2 or more and was not promised by the source, a read of a word written less
// than `distance` iterations ago gives the complement of that word (hardware may give the old or the new one, so a
// graph that uses it is wrong).

#include <llvm/ADT/APInt.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dataflow/graph.hpp"
#include "dataflow/translate.hpp"

namespace epiline::dataflow {

/// What became of an attempt at one iteration.
enum class outcome : std::uint8_t {
  advanced,        // it took place
  blocked,         // a port it must read has no token; nothing changed
  broken_promise,  // the source promised what does not hold; nothing changed, and it will not advance again
};

class interpreter {
 public:
  struct progress {
    outcome last = outcome::advanced;  // advanced: the limit was reached
    std::uint64_t iterations = 0;      // that took place
  };

  /// Translates `g`, which need not outlive the call. Throws std::invalid_argument with find_violation's sentence for a
  /// graph that breaks a rule, and for memories of more than 2^32 bits in total.
  explicit interpreter(const graph& g);

  /// Attempts one iteration.
  outcome step();

  /// Attempts iterations until one does not take place or `max_iterations` have.
  progress run_until_blocked(std::uint64_t max_iterations);

  /// Registers return to their initial values and all queues are emptied; memories keep their contents.
  void reset();

  /// Appends a token to the queue of an input port. Throws std::invalid_argument when `port` is no input port or the
  /// token has another width (APInt) or does not fit the port's (std::uint64_t).
  void push(port_id port, const llvm::APInt& token);
  void push(port_id port, std::uint64_t token);

  /// Takes the oldest token from the queue of an output port; empty if there is none. Throws std::invalid_argument when
  /// `port` is no output port or, for pop_word, wider than 64 bits.
  std::optional<llvm::APInt> pop(port_id port);
  std::optional<std::uint64_t> pop_word(port_id port);

  /// Tokens waiting in the queue of a port, input or output. Throws std::invalid_argument for an unknown port.
  [[nodiscard]] std::size_t available(port_id port) const;

  /// The port of that direction and name, or `none`.
  [[nodiscard]] port_id find_port(std::string_view name, bool input) const;

  /// Current value of a register, current word of a memory (for tests and traces).
  /// Throw std::out_of_range for an unknown id or address.
  [[nodiscard]] llvm::APInt register_value(register_id id) const;
  [[nodiscard]] llvm::APInt memory_word(memory_id id, std::uint64_t address) const;

  /// After `blocked`: the port the iteration waits for; otherwise `none`.
  [[nodiscard]] port_id blocked_on() const { return blocked_on_; }

  /// Iterations that took place since construction or reset.
  [[nodiscard]] std::uint64_t iterations() const { return iterations_; }

  /// After `blocked` or `broken_promise`: one sentence naming the port or memory, its source line and the iteration.
  [[nodiscard]] std::string message() const;

 private:
  struct queue {
    std::vector<std::uint64_t> words;
    std::size_t head = 0;  // first word of the oldest token
    unsigned words_a_token = 1;
    void drop_oldest();
  };
  struct memory_state {
    std::string name;
    std::string place;
    unsigned words, width, words_a_word, distance;
    bool promised;
    std::vector<std::uint64_t> contents;
    std::vector<std::uint64_t> written;  // iteration + 1 of the last write, a word; only when distance > 1
  };
  struct table_state {
    unsigned width;
    std::vector<std::uint64_t> words;
    std::uint64_t count;
  };
  struct port_state {
    std::string name;
    std::string place;
    unsigned width;
    bool input;
  };
  struct register_info {
    std::string name;
    std::string place;
    location value;
    std::optional<llvm::APInt> initial;
  };
  struct undo_entry {
    memory_id memory;
    std::uint64_t address, stamp;
    std::size_t saved;  // offset in undo_words_
  };

  bool execute(const batch& b);  // false: blocked or broken
  void execute_wide(const wide_instruction& w);
  bool execute_read(const port_access& access);
  bool execute_memory_read(const memory_access& access);
  void execute_memory_write(const memory_access& access, bool undoable);
  bool address_of(const memory_access& access, std::uint64_t& address) const;
  bool check_patience();
  void roll_back();
  void commit();
  llvm::APInt load(location where) const;
  void store(location where, const llvm::APInt& value);
  const port_state& checked_port(port_id port, bool input) const;

  translation program_;
  std::vector<register_info> registers_;
  std::vector<std::uint64_t> staged_;  // next values, while the old ones are still read
  std::vector<memory_state> memories_;
  std::vector<table_state> tables_;
  std::vector<port_state> ports_;
  std::vector<queue> queues_;

  std::vector<undo_entry> undo_;
  std::vector<std::uint64_t> undo_words_;
  std::uint64_t iterations_ = 0;
  port_id blocked_on_ = none;
  std::string broken_;
};

}  // namespace epiline::dataflow
