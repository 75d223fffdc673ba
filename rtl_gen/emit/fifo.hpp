#pragma once
// The FIFO between two processes: its module, and what one costs.

#include <string>

#include "dataflow/network.hpp"
#include "schedule/delay_model.hpp"

namespace epiline::emit {

struct fifo_plan {
  schedule::storage_kind storage = schedule::storage_kind::distributed;
  unsigned depth = 2;         // places of its RAM; the word at its output is one more
  unsigned pointer_bits = 1;  // of a place's number
  double luts = 0;
  unsigned flip_flops = 0;
  unsigned block_rams = 0;
};

[[nodiscard]] fifo_plan plan_fifo(const dataflow::fifo& f, const schedule::delay_model& model);

/// epiline_fifo_distributed or epiline_fifo_block.
[[nodiscard]] std::string fifo_module_name(schedule::storage_kind storage);

/// The module's text, guarded by a macro so that several generated files compile together. Parameters: WIDTH, DEPTH,
/// POINTER (bits of a place's number), LAST (DEPTH - 1 in so many bits).
[[nodiscard]] std::string fifo_module(schedule::storage_kind storage);

}  // namespace epiline::emit
