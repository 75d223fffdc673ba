#pragma once

#include <cstdint>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// For every node the number of the cycle (strongly connected component through registers and memories) it lies on, or
/// `none`. Two nodes with one number depend on each other from iteration to iteration.
[[nodiscard]] std::vector<std::uint32_t> cycles_of(const dataflow::graph& g);

}  // namespace epiline::passes
