#pragma once
// How many inputs every value drives: what makes wires slow, and what copies of registers are for.

#include <cstdint>
#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/delay_model.hpp"

namespace epiline::schedule {

/// One who reads a value: a node by its number, or a register (its next value or its enable) by the number of nodes
/// plus its own. Numbers follow the source, so that neighbours in number are neighbours in the design.
using reader = std::uint32_t;

struct load {
  dataflow::node_id value = dataflow::none;
  reader by = 0;
  double inputs = 0;     // that one bit of the value drives there, wires behind it followed to their ends
  bool enables = false;  // the value decides whether the reader, a register or a memory, is updated
};

/// Inputs that one bit of an address, or of an enable, of memory `m` drives.
[[nodiscard]] double memory_inputs(const dataflow::graph& g, const delay_model& model, dataflow::memory_id m);

/// Every read of every value that is not a constant, in the order of the readers. What stands behind a wire (a slice,
/// an extension) loads the wire's operand, too.
[[nodiscard]] std::vector<load> find_loads(const dataflow::graph& g, const delay_model& model);

/// What many readers cost beyond the wire that delay_model::delay() counts, in nanoseconds per node.
struct spread {
  std::vector<double> readers;  // the inputs that one bit of the node's result drives
  std::vector<double> after;    // on the way from the node's result to readers in its own stage
  std::vector<double> before;   // from the operands to the node, also where they come from flip-flops: not every reader
                                // can be next to the flip-flop, or to the copy of it, that it reads
};
[[nodiscard]] spread find_spread(const dataflow::graph& g, const delay_model& model);

}  // namespace epiline::schedule
