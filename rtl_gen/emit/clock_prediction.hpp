#pragma once
// The period that a design will have after place and route: its longest chain in delays that were fitted to routed
// designs of the device. It is computed for a finished schedule, which it does not change: the scheduler keeps its own
// delays (schedule/delay_model.hpp), which leave room for wires; these tell how long wires become.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataflow/graph.hpp"
#include "emit/plan.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/schedule.hpp"

namespace epiline::emit {

/// Delays of a device in nanoseconds, as scripts/delay_fit.py finds them in nextpnr's reports of routed designs.
struct device_delays {
  // Of cells, each on its own.
  double clock_to_out = 0;        // flip-flop
  double lut = 0;                 // any input to the output
  double carry_entry = 0;         // operand to carry
  double carry_bit = 0;           // carry over one bit
  double carry_exit = 0;          // carry to sum
  double multiplier = 0;          // operand to product
  double distributed_read = 0;    // LUT RAM, address to word
  double block_clock_to_out = 0;  // block RAM, with its own output register
  double block_setup = 0;         // block RAM's inputs
  double setup = 0;               // flip-flop's input, with the wire inside the slice
  double enable_setup = 0;        // flip-flop's clock enable or clear
  // Of wires. The side of a design is the square root of its logic cells (of its LUT4 or of its flip-flops, whichever
  // is more).
  double wire = 0;             // from one cell to the next, with one reader
  double reader_doubling = 0;  // for every doubling of the readers
  double block_wire = 0;       // wires more than between two cells to or from a block RAM: they stand in few columns
  double side_doubling = 0;    // once in a chain, for every doubling of the side beyond compact_side: of all its chains
                               // the placement of a large design leaves some with a long wire
};

/// The side, in logic cells, up to which a design is so small that no wire of it is long.
inline constexpr double compact_side = 8;

/// Of a file of delays: {"schema": "epiline-device-delays/1", "target", "cells_ns": {..}, "wires_ns": {..}}. Throws
/// std::invalid_argument, saying what is wrong, for another text, a delay that is missing, or one below zero.
[[nodiscard]] device_delays read_device_delays(const std::string& text);

/// Those that were fitted for `target` and are built in; nothing where there are none.
[[nodiscard]] std::optional<device_delays> fitted_delays(std::string_view target);

/// What lies beside a chain on the device, which decides how long wires become.
struct design_size {
  double luts = 0;
  double flip_flops = 0;

  [[nodiscard]] double side() const;
};

/// What a chain from clock to clock goes through.
struct timed_chain {
  double cells = 0;      // nanoseconds
  double wires = 0;      // one after another; a part of one where a cell holds several operations
  double doublings = 0;  // of the readers of these wires, together
};

struct clock_prediction {
  double period = 0;  // nanoseconds
  timed_chain longest;
  double side = 0;  // of the design
  std::string end;  // what the chain ends in
  dataflow::source_location where;
  std::vector<timed_chain> chains;  // all that would be the longest in some other delays of wires
};

[[nodiscard]] clock_prediction predict_clock(const dataflow::graph& g, const schedule::delay_model& model,
                                             const schedule::result& s, const plan& p, const device_delays& delays,
                                             const design_size& size);

/// Key "prediction" of the report. prediction_text() is the same for people, one line.
[[nodiscard]] nlohmann::json to_json(const dataflow::graph& g, const clock_prediction& prediction);
[[nodiscard]] std::string prediction_text(const nlohmann::json& prediction);

}  // namespace epiline::emit
