#pragma once
// Cuts a top with `#pragma HLS DATAFLOW`, a sequence of calls of functions that take streams, into its processes. Each
// of them is the whole top with the other calls left out: so a process has the scalars it is called with, computed from
// those of the top, and everything behind this goes on as if it were a top of its own.

#include <llvm/IR/Module.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "frontend/compile.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

/// What only the debug information knows of the top.
struct top_description {
  source_place place;
  std::map<unsigned, std::string> parameters;  // names, by index from 0
};

/// The FIFO's depth of a stream that says nothing about it, as in the vendors' tools.
inline constexpr unsigned default_depth = 2;

/// A stream between processes: a local or static hls::stream, or an element of an array of them.
struct internal_stream {
  std::string name;  // unlike every other stream's and parameter's
  unsigned depth = default_depth;
  bool depth_given = false;  // by the source
  bool is_static = false;    // keeps tokens from call to call
  source_place place;
};

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

/// The function of that name, with or without its scopes, that has a body; null: there is none.
[[nodiscard]] llvm::Function* find_top(llvm::Module& module, const std::string& top);

inline constexpr const char* internal_stream_name = "__epiline_internal_stream";

/// Takes the module out of `source`, adds notes about pragmas without effect to it. Throws `refused` for a top with
/// DATAFLOW that is no such sequence, and when processes are joined by anything else than streams.
[[nodiscard]] split_top split_into_processes(compiled_source& source, const source_options& options);

}  // namespace epiline::frontend
