#pragma once
// Runs a counterexample in the dataflow interpreter, which knows nothing of the solver's terms.

#include <llvm/ADT/APInt.h>

#include <cstdint>
#include <map>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::prove {

/// Where an iteration starts.
struct concrete_start {
  std::vector<llvm::APInt> registers;                       // by register
  std::vector<std::map<std::uint64_t, llvm::APInt>> words;  // by memory: those that matter; others are 0
  std::vector<llvm::APInt> tokens;                          // by port, of its width
};

/// What one iteration did.
struct concrete_end {
  bool advanced = false;
  std::vector<bool> accessed;                               // by port
  std::vector<llvm::APInt> tokens;                          // by port: those given; zero for others
  std::vector<llvm::APInt> registers;                       // by register
  std::vector<std::map<std::uint64_t, llvm::APInt>> words;  // at the indices of the start
};

/// One iteration of `g` from there. Memories hold no write younger than their distance.
[[nodiscard]] concrete_end run_one_iteration(dataflow::graph g, const concrete_start& start);

}  // namespace epiline::prove
