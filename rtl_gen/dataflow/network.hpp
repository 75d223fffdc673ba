#pragma once
// A top made of processes: dataflow graphs that run side by side, joined by FIFOs. Names join them: a stream port of a
// process is an end of the FIFO of that name or, when there is none, the top's own port of that name.
//
// Meaning: every process performs its iterations as graph.hpp says, as soon as the tokens are there. A write waits
// while its FIFO is full. Since only that and missing tokens ever make a process wait, and nobody can see either, the
// tokens of every stream do not depend on who is faster (a Kahn network).
//
// A call token of the top goes to every process that has a call port, which has some of its fields. It is accepted when
// all of them can take it.

#include <cstdint>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::dataflow {

using process_id = std::uint32_t;
using fifo_id = std::uint32_t;

inline constexpr unsigned max_fifo_depth = 1u << 20;

struct fifo {
  std::string name;  // of the stream in the source
  unsigned width = 1;
  unsigned depth = 2;     // tokens it holds, at least
  source_location where;  // in network::files
};

/// A port of a process.
struct endpoint {
  process_id process = none;
  port_id port = none;
};

struct network {
  std::string name;                // the top function's
  std::vector<std::string> files;  // source file names, as given to the compiler
  std::vector<port> ports;         // of the top
  std::vector<fifo> fifos;
  std::vector<graph> processes;         // in the order of their calls
  std::vector<source_location> called;  // where each process is called, in network::files
};

/// One graph as a network without FIFOs.
[[nodiscard]] network network_of(graph g);

/// Whether it is no more than one graph.
[[nodiscard]] inline bool is_single(const network& n) { return n.processes.size() == 1 && n.fifos.empty(); }

/// Checks every rule stated in this file: each FIFO has one writer and one reader, each port of the top a port of a
/// process (a call port: every call port of a process, whose fields are among its own), with equal widths; and those of
/// the graphs. Returns an empty string, or one sentence naming the first rule broken and where.
[[nodiscard]] std::string find_violation(const network& n);

/// The port of a process that writes, or reads, the stream of that name; none: no process does.
[[nodiscard]] endpoint find_end(const network& n, const std::string& stream, bool input);

}  // namespace epiline::dataflow
