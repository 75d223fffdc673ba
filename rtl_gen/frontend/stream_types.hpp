#pragma once
// Which streams a type of the source holds: LLVM's types have forgotten it, the debug information knows.

#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Function.h>

#include <cstdint>
#include <string>
#include <vector>

namespace epiline::frontend {

/// The hls::stream that a type is, perhaps in arrays and, if wanted, behind a reference or pointer; null: it is none.
[[nodiscard]] const llvm::DICompositeType* stream_type(const llvm::DIType* type, bool behind_references);

/// A stream in a variable: the variable itself, an element or a member of it.
struct placed_stream {
  std::uint64_t offset = 0;  // in bytes
  std::uint64_t array = 0;   // that of the first one of the innermost array it is in, or its own
  const llvm::DICompositeType* type = nullptr;
  std::string name;
};

/// The streams that a variable of this type and name holds.
[[nodiscard]] std::vector<placed_stream> streams_in(const llvm::DIType* type, const std::string& name = "");

/// The largest depth a stream can have.
inline constexpr unsigned most_depth = 1u << 20;

/// DEPTH of hls::stream<T, DEPTH>; 0 without.
[[nodiscard]] unsigned depth_of(const llvm::DICompositeType& type);

/// A function that can be a process: one that takes streams and is not one of the streams' own.
[[nodiscard]] bool takes_streams(const llvm::Function& function);

/// Whether a function, or one that runs when it does, has streams of its own: it joins processes.
[[nodiscard]] bool joins_streams(const llvm::Function& root);

}  // namespace epiline::frontend
