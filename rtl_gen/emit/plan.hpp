#pragma once
// What the hardware beside the operations is: copies of values that wait for a later stage, delay lines in RAM, FIFOs,
// RAMs. Shared by the Verilog and the report, so that the report counts what is emitted.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/fan_out.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

/// From which length on a wait is put into RAM instead of flip-flops.
struct delay_line_limits {
  int distributed_clocks = 6;     // LUT RAM from here on
  int block_clocks = 17;          // block RAM from here on, if block_bits wait together; LUT RAM otherwise
  unsigned distributed_bits = 8;  // fewer bits than these stay in flip-flops
  unsigned block_bits = 24;
};

/// A value's way from the stage where it is there to the last stage that uses it, one step after another.
struct wait_step {
  int from = 0;
  int to = 0;
  int line = -1;  // index of plan::lines, or -1: one flip-flop a clock
};

/// Several values that wait for the same clocks, side by side in the words of one circular memory.
struct delay_line {
  int from = 0;
  int to = 0;
  unsigned width = 0;
  schedule::storage_kind storage = schedule::storage_kind::distributed;
  std::vector<dataflow::node_id> values;  // low bits first
  std::size_t pointers = 0;               // which copy of the pointers of its length

  [[nodiscard]] int clocks() const { return to - from; }
  /// Words of the circular memory: the remaining clocks pass in the registers after it.
  [[nodiscard]] int words() const { return storage == schedule::storage_kind::block ? clocks() - 1 : clocks(); }
};

/// From the gate that lets a word leave an output's FIFO to the counter of its free places.
inline constexpr int clocks_to_credits = 4;

struct output_fifo {
  dataflow::port_id port = dataflow::none;
  std::vector<dataflow::node_id> writes;
  int stage = 0;
  unsigned depth = 0;  // a power of two, larger than all that can be in flight
  schedule::storage_kind storage = schedule::storage_kind::distributed;
};

struct read_port {
  dataflow::node_id address = dataflow::none;
  int stage = 0;
  std::vector<dataflow::node_id> reads;
};

struct memory_plan {
  schedule::storage_kind storage = schedule::storage_kind::block;
  std::vector<read_port> reads;
  std::vector<dataflow::node_id> writes;
  bool exclusive_writes = true;  // at most one of them is enabled: they share one write port
  bool never_meets = true;       // a read never looks at the word written in the same clock
};

/// Flip-flops that hold the same bits, each for some of the readers: one that drives too many is slow, and far from
/// most of them. Copy 0 is the flip-flop itself.
struct copies {
  std::vector<schedule::reader> first_reader;  // per copy: it serves the readers from this one to the next copy's

  [[nodiscard]] std::size_t count() const { return first_reader.size(); }
  /// The copy that serves `by`.
  [[nodiscard]] std::size_t of(schedule::reader by) const;
};

/// Whether a reset brings back the initial value of register `r`. Settled values are reset even where the source wants
/// none: they are few, and one of them has two flip-flops that must agree.
[[nodiscard]] bool is_reset(const dataflow::graph& g, const schedule::result& s, dataflow::register_id r);

struct plan {
  std::vector<std::vector<wait_step>> waits;  // per node
  std::vector<delay_line> lines;
  std::vector<output_fifo> fifos;
  std::vector<memory_plan> memories;
  std::map<std::pair<dataflow::node_id, int>, copies> value_copies;  // of what waits in flip-flops, by value and stage
  std::vector<copies> valid_copies;                                  // per stage; stage 0 has none
  int last_valid = 1;                                                // the last stage that needs its valid bit
  /// Bits that are 1 where a stage holds an iteration and a condition is true in it, by condition and stage: they are
  /// the clock enables of the state and the memories that the condition updates. Made a stage earlier, wherever the
  /// condition is known then: no gate stands between them and the enables.
  std::map<std::pair<dataflow::node_id, int>, copies> update_bits;
  /// Where much state is reset, the reset comes to it through two rows of flip-flops: the last one, and the one before.
  copies reset_copies{{0}}, early_reset_copies{{0}};
  std::uint64_t copy_bits = 0;   // flip-flops of waiting values
  std::uint64_t spare_bits = 0;  // flip-flops of update_bits and resets, and of other copies beside the first ones

  [[nodiscard]] bool has_reset_rows() const { return reset_copies.count() > 1; }
  std::uint64_t settled_bits = 0;  // flip-flops of settled values and of patient registers' next values
};

[[nodiscard]] plan make_plan(const dataflow::graph& g, const schedule::delay_model& model, const schedule::result& s,
                             const delay_line_limits& limits = {});

}  // namespace epiline::emit
