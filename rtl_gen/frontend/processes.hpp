#pragma once
// Cuts a top with `#pragma HLS DATAFLOW`, a sequence of calls of functions that take streams, into its processes. Each
// of them is the whole top with the other calls left out: so a process has the scalars it is called with, computed from
// those of the top, and everything behind this goes on as if it were a top of its own.

#include <llvm/IR/Module.h>

#include <memory>
#include <string>
#include <vector>

#include "frontend/compile.hpp"
#include "frontend/process_streams.hpp"
#include "frontend/source.hpp"
#include "frontend/top_function.hpp"

namespace epiline::frontend {

/// What is to be lowered: a whole top or one process of it.
struct process_source {
  std::string name;  // of the graph and the module made of it
  std::unique_ptr<llvm::Module> module;
  source_place place;  // of the top, or of the call that this process is
  top_description top;
  bool is_part = false;  // of a top: it may use some of the top's parameters only
  /// Of the top. In the module their objects are named by calls of internal_stream_name with their numbers.
  std::vector<std::string> streams;
};

struct split_top {
  std::string name;  // without scopes
  top_description top;
  std::vector<process_source> processes;  // in the order of their calls; one without DATAFLOW
  std::vector<internal_stream> streams;
};

/// Takes the module out of `source`, adds notes about pragmas without effect to it. Throws `refused` for a top with
/// DATAFLOW that is no such sequence, and when processes are joined by anything else than streams.
[[nodiscard]] split_top split_into_processes(compiled_source& source, const source_options& options);

}  // namespace epiline::frontend
