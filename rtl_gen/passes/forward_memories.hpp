#pragma once

#include <stdexcept>

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// What the source asks of a memory cannot be built; the message names the memory and its line.
class memory_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Moves every memory write behind all reads: a read that stood behind a write of its iteration chooses between the
/// written data and the old word. Throws memory_error for a memory with more than one write node.
void order_memory_accesses(dataflow::graph& g);

/// For every memory whose written data depends on a word read from it in the same iteration (read, modify, write) and
/// whose source promises no distance: keeps its last `writes` writes in registers and lets reads take the data from
/// there, so that the memory itself may lag `writes` iterations behind (distance 1 + writes) and the loop fits a
/// pipeline. Needs the order order_memory_accesses makes.
void forward_memories(dataflow::graph& g, unsigned writes = 1);

}  // namespace epiline::passes
