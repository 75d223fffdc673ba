#pragma once
// The text form of a network: its own lines, then every process as text.hpp writes it, each after a line `process`.
//
//   network "top"
//   file "top.cpp"
//   input stream "in" 8 @0:20
//     field "data" "tdata" 8
//   fifo "between" 8 depth 4 @0:22
//   process @0:24                                     ; where it is called
//   graph "top_load"
//   ...
//   process @0:25
//   graph "top_store"
//   ...

#include <string>
#include <string_view>

#include "dataflow/network.hpp"
#include "dataflow/text.hpp"

namespace epiline::dataflow {

/// The text form. `n` must keep every rule of network.hpp.
[[nodiscard]] std::string print(const network& n);

/// The shortest text form: of a network that is a single graph that graph's.
[[nodiscard]] std::string print_design(const network& n);

/// The network a text describes; that of one process if the text is a graph's. Throws text_error for anything else.
[[nodiscard]] network parse_network(std::string_view text);

}  // namespace epiline::dataflow
