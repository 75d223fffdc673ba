#pragma once
// Native = dataflow graph = RTL: plays a program's recorded input into a level and compares what comes out.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cosim/model.hpp"
#include "dataflow/network.hpp"
#include "token_file.hpp"

namespace epiline::compiler_test {

struct graph_verdict {
  std::string difference;        // empty: equal
  std::uint64_t iterations = 0;  // that took place
  bool waits = false;  // iterations wait for one another (patient registers, streams that lead backwards): clocks are
                       // no fixed number
};

/// The graph, or the network of graphs, interpreted.
[[nodiscard]] graph_verdict check_graph(const dataflow::network& design, const std::vector<recorded_port>& recorded);

/// The circuit, under several patterns of random pauses. `clocks`, if known (not 0), bound the run without pauses
/// (a pipeline may take some more to fill and drain). Returns an empty string or what is wrong.
/// Every pattern gets a model of its own from `make`: memories keep their contents over a reset, C++'s statics are
/// fresh.
[[nodiscard]] std::string check_rtl(const std::function<std::unique_ptr<cosim::rtl_model>()>& make,
                                    const std::vector<recorded_port>& recorded, std::uint64_t seed,
                                    std::uint64_t clocks);

}  // namespace epiline::compiler_test
