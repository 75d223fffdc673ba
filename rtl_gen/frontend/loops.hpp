#pragma once

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/PassManager.h>

#include <algorithm>
#include <cstdint>

namespace epiline::frontend {

/// Whether the loop has an instruction of that kind.
template <class Kind>
[[nodiscard]] bool any_in(const llvm::Loop& loop, const Kind& is_of_kind) {
  return std::any_of(loop.block_begin(), loop.block_end(), [&](const llvm::BasicBlock* block) {
    return std::any_of(block->begin(), block->end(), is_of_kind);
  });
}

/// Notes at every UNROLL pragma call which loop it stands in: the optimiser takes loops away that never come to a
/// second pass, and the pragma must not pass to the loop around. Before any of LLVM's passes.
void note_loops_of_pragmas(llvm::Function& function);

/// Takes the PIPELINE and UNROLL pragma calls out of the function and unrolls loops:
///   - a loop that accesses streams, has a run-time trip count or is marked PIPELINE stays a loop;
///   - a constant loop inside such a loop, or marked UNROLL, is unrolled fully;
///   - of a loop marked UNROLL factor=N, N passes become one;
///   - a nest of constant loops outside of all others is unrolled when it is short; a loop around one that stays,
///   stays.
/// Refuses endless loops without stream access and UNROLL of loops whose trip count is not known.
/// Returns the largest initiation interval that a PIPELINE pragma allows (1 without).
/// `every_loop`: unroll outer constant loops as readily as inner ones.
unsigned unroll_loops(llvm::Function& function, llvm::FunctionAnalysisManager& analyses, bool every_loop = false);

/// Turns `while` loops into guarded do-while form where that duplicates no access, so that nested loops flow into each
/// other without an idle clock.
void rotate_loops(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);

/// How often a block is reached when a loop runs, once in each pass; 0: it is not known, or not once.
[[nodiscard]] std::uint64_t passes_through(const llvm::Loop& loop, const llvm::BasicBlock& block,
                                           const llvm::DominatorTree& dominators, llvm::ScalarEvolution& evolution);

/// What a loop with a known number of passes leaves of a counter is computed from what the counter was before it: so
/// one that goes on through nested loops is known to do so. Changes no access.
void compute_results_of_loops(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);

/// Keeps the next value of every loop counter in a register of its own, so that the test "does the loop go on" need not
/// wait for the increment: compare and add take place side by side, not one after the other in one clock.
void look_ahead(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);

/// Writes what is known of the range of loop counters into the code, as truncation and zero extension: C++ counts in
/// 32 bits where 10 would do.
void narrow_counters(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);

}  // namespace epiline::frontend
