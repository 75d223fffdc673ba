#pragma once

#include <vector>

#include "dataflow/network.hpp"
#include "frontend/lower.hpp"
#include "frontend/processes.hpp"

namespace epiline::frontend {

/// The network that the processes of a top make together: `lowered` and `graphs` belong to split.processes, one by one.
/// Throws `refused` when a stream does not have one writer and one reader, or is read before anybody can have written.
[[nodiscard]] dataflow::network join_processes(const split_top& split, const std::vector<lowered_process>& lowered,
                                               std::vector<dataflow::graph> graphs);

}  // namespace epiline::frontend
