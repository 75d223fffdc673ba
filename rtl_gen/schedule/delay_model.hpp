#pragma once
// What one operation costs on a target: nanoseconds, LUTs, clocks of a memory. Estimates for scheduling and reports.

#include <cstdint>
#include <string>
#include <string_view>

#include "dataflow/graph.hpp"

namespace epiline::schedule {

/// Where a memory or a table lives.
enum class storage_kind {
  logic,        // a table made of LUTs: its result is combinational
  distributed,  // LUT RAM: written by the clock, read combinationally
  block,        // block RAM: address and output both registered, the word is usable two stages after the address
};

[[nodiscard]] const char* name_of(storage_kind kind);

/// Delays in nanoseconds, wires included; areas in LUT4 (a carry cell counts as the two LUT4 it occupies).
struct delay_parameters {
  double launch = 0;       // clock to the output of a flip-flop, and the wire to the first operation
  double capture = 0;      // set-up time of a flip-flop
  double lut_level = 0;    // one LUT and the wire after it
  double carry_entry = 0;  // operand to carry
  double carry_bit = 0;    // carry over one bit
  double carry_exit = 0;   // carry to sum, and the wire after it
  double multiplier = 0;   // one hardware multiplier and the wire after it; 0: there is none
  unsigned multiplier_width = 0;
  double distributed_read = 0;         // address to word for 16 words; every doubling costs half a LUT level
  unsigned distributed_max_words = 0;  // 0: the target has no LUT RAM
  double memory_setup = 0;             // set-up of a RAM's address, data and enable inputs
  double block_wire = 0;  // what the wire to a block RAM's inputs is longer than others: RAMs stand in columns of their
                          // own, far from most of the logic
  double issue = 0;       // from a read's predicate through the decision to issue, one LUT that also takes in the
                          // predicate's last gate, to the clock enables it drives
  double spread_doubling = 0;  // what every doubling of a value's readers adds to its wire, from spread_from on
  // The same for all targets: these hang on the shape of designs more than on the device.
  double calm_share = 0.85;  // of the period, for chains outside recurrences: a register there costs no throughput, and
                             // wires come out longer than estimated somewhere in every placement
  double spread_from = 8;    // readers
  double spread_of_copies = 0.5;     // the share of it that stays where the value comes from flip-flops with copies
  double most_spread_of_copies = 1;  // nanoseconds
  unsigned most_readers = 16;        // inputs that one flip-flop drives: from there on it has copies
  unsigned most_enabled = 48;        // flip-flops that one clock enable drives: a row of slices or two
  unsigned most_reset = 4096;        // flip-flops that one reset clears: few different resets, or slices fill badly
  unsigned very_many_readers = 64;   // from here on a value is in a flip-flop for a clock before its copies are
  unsigned many_blocks = 8;  // block RAMs of one memory: from here on its words pass a flip-flop for their wires
  unsigned block_bits = 0;   // of one block RAM
  unsigned block_max_width = 0;
};

class delay_model {
 public:
  /// `target`: "ecp5", "hx8k" or "generic". Throws std::invalid_argument, naming the known ones, for anything else.
  explicit delay_model(std::string_view target);

  /// The same target with other delays.
  [[nodiscard]] delay_model with(const delay_parameters& parameters) const {
    delay_model other = *this;
    other.parameters_ = parameters;
    return other;
  }

  [[nodiscard]] const std::string& target() const { return target_; }
  [[nodiscard]] const delay_parameters& parameters() const { return parameters_; }

  /// Combinational delay from the operands of node `id` to its result.
  [[nodiscard]] double delay(const dataflow::graph& g, dataflow::node_id id) const;
  /// Stages from the one a node stands in to the one its result can be used in: 0, or 2 for a block RAM's word.
  [[nodiscard]] int latency(const dataflow::graph& g, dataflow::node_id id) const;
  /// What a path into operand `index` of node `id` costs beyond delay(): set-up of a RAM, gating of an enable.
  [[nodiscard]] double entry(const dataflow::graph& g, dataflow::node_id id, std::size_t index) const;
  /// Gating of a register's enable with its stage's valid bit.
  [[nodiscard]] double enable_entry() const { return parameters_.lut_level; }
  /// Estimated LUT4 of node `id`.
  [[nodiscard]] double area(const dataflow::graph& g, dataflow::node_id id) const;

  [[nodiscard]] storage_kind storage(const dataflow::memory& m) const;
  [[nodiscard]] storage_kind storage(const dataflow::table& t) const;
  /// LUT4 that `words` words of `width` bits take as LUT RAM.
  [[nodiscard]] double distributed_area(std::uint64_t words, std::uint64_t width) const;
  /// Block RAMs that one copy of `words` words of `width` bits takes.
  [[nodiscard]] unsigned blocks(std::uint64_t words, std::uint64_t width) const;

 private:
  std::string target_;
  delay_parameters parameters_;
};

/// True when the operand or node is a wire only: no gate, no delay (slices, extensions, concatenations, inversions that
/// the next LUT absorbs, shifts by a constant).
[[nodiscard]] bool is_wire(const dataflow::graph& g, dataflow::node_id id);

}  // namespace epiline::schedule
