#pragma once
// Levels that are dataflow graphs: run by the interpreter.

#include "check/answer.hpp"
#include "dataflow/network.hpp"

namespace epiline::check {

struct graph_verdict {
  std::string problem;  // empty: equal
  difference where;     // the token that differs, if that is the problem
  std::vector<token_list> outputs;
  std::uint64_t iterations = 0;
};

/// `most_iterations`: it is a problem if more take place.
[[nodiscard]] graph_verdict run_graph(const dataflow::network& n, const reference& wanted,
                                      std::uint64_t most_iterations);

/// The source lines from which port `id` is written, as far as the graph tells: "file.cpp:12".
[[nodiscard]] std::string write_place(const dataflow::network& n, dataflow::port_id id);

}  // namespace epiline::check
