#pragma once
// Where things come from in the user's source, and the one error every part of the frontend reports with.

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/DebugLoc.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instruction.h>

#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::frontend {

/// The source uses something the flow does not support, or is wrong. what() is "FILE:LINE: error: TEXT" on one line;
/// what clang itself printed is passed on unchanged.
class refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A place in the user's code: not in the type headers, which are inlined everywhere.
struct source_place {
  std::string file;
  unsigned line = 0;
};

[[nodiscard]] source_place place_of(const llvm::DebugLoc& location);
/// The instruction's own place or, when optimisation lost it, that of the nearest instruction before it.
[[nodiscard]] source_place place_of(const llvm::Instruction& instruction);
[[nodiscard]] source_place place_of(const llvm::Function& function);

/// place_of of many instructions: looks through each block once.
class instruction_places {
 public:
  [[nodiscard]] source_place of(const llvm::Instruction& instruction);

 private:
  std::unordered_map<const llvm::Instruction*, const llvm::Instruction*> nearest_;  // that has a place
};

[[nodiscard]] source_place place_of(const llvm::DIVariable& variable);
/// The line of `for`, `while` or `do`.
[[nodiscard]] source_place place_of(const llvm::Loop& loop);

/// Whether a file is the user's: neither of the types, nor of the frontend, nor of the system.
[[nodiscard]] bool is_users_file(const std::string& path);
/// A path as a person would write it from here.
[[nodiscard]] std::string shown_path(const std::string& path);

[[nodiscard]] bool is_users(const llvm::Function& function);

/// Throws `refused` at a place: what was found there, and what to do instead.
[[noreturn]] void refuse(const source_place& place, const std::string& what);

/// The function's or variable's name as the user wrote it.
[[nodiscard]] std::string readable_name(const llvm::Function& function);

/// The source variable that a value belongs to, by debug information or by the name the splitting gave it.
[[nodiscard]] std::string readable_name(const llvm::Instruction& value);

}  // namespace epiline::frontend
