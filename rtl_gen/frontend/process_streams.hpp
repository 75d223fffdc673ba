#pragma once
// The streams between the processes of a top with DATAFLOW: which objects they are, their names and depths.

#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "frontend/stream_types.hpp"
#include "frontend/top_function.hpp"

namespace epiline::frontend {

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

/// Names such a stream's object in the module: called with the stream's number, a pointer, and where in the object the
/// array begins that the stream is in.
inline constexpr const char* internal_stream_name = "__epiline_internal_stream";

/// Collects the streams of one top, in the order in which they are found.
class process_streams {
 public:
  process_streams(llvm::Module& module, const top_description& top) : module_(module), top_(top) {}

  /// Notes the local streams of a function, before those that nobody uses vanish.
  void note_declared(const llvm::Function& function);

  /// Finds the local streams of `process`, where everything but the processes is inlined, and the static ones.
  /// `locals_are_kept`: the local streams keep tokens from call to call as the static ones do.
  void find(llvm::Function& process, bool locals_are_kept);

  /// One that the source does not know: `channel` stands for it.
  void add(llvm::Value& channel, const std::string& name, bool is_static, const source_place& place);

  /// Refuses a stream that was noted and not found.
  void check_declared() const;

  /// Gives the depths of #pragma HLS STREAM to the streams, and removes the pragmas; those in functions that are left
  /// over from inlining count for nothing. Appends notes about pragmas without effect.
  void take_pragmas(llvm::function_ref<bool(const llvm::Function&)> is_left_over, std::vector<std::string>& notes);

  /// Says in `process` which object is which stream, where they all exist.
  void mark(llvm::Function& process) const;

  /// The variables that are nothing else than streams.
  [[nodiscard]] std::set<const llvm::Value*> objects() const;

  [[nodiscard]] const std::vector<internal_stream>& all() const { return streams_; }

 private:
  /// An object of streams: one, or an array.
  struct stream_object {
    llvm::Value* object;
    const llvm::DIVariable* variable;
    std::vector<placed_stream> streams;
    std::vector<std::size_t> numbers;  // of these streams, one by one
    bool is_pure = true;               // it is nothing else than streams
  };

  void add_object(llvm::Value& object, const llvm::DIVariable& variable, bool is_static);
  void take_pragma(const llvm::CallInst& call, std::vector<std::string>& notes);

  llvm::Module& module_;
  const top_description& top_;
  std::set<const llvm::DILocalVariable*> declared_;
  std::vector<stream_object> objects_;
  std::vector<std::pair<llvm::Value*, std::size_t>> channels_;  // with the numbers of their streams
  std::vector<internal_stream> streams_;
  std::set<std::string> names_;
};

}  // namespace epiline::frontend
