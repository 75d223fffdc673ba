#pragma once
// Tables that the source fills with code: by a loop over a local array at the beginning of a call, or into a static
// variable at the first one (`if (!initialized) { ...; initialized = true; }`, and what C++ does by itself for a static
// of a function). Where the code needs nothing that only the hardware knows, it is run here, and hardware has the
// table.

#include <llvm/IR/Function.h>

#include "frontend/function_passes.hpp"

namespace epiline::frontend {

/// Runs what fills static variables at first calls, in all functions together, whose local variables must be values.
/// Returns whether there was something to run.
bool run_first_calls(llvm::Module& module);

/// Runs what fills tables in `process`: everything at a first call, loops over floating point, which nothing but this
/// could make into hardware, and loops that end nobody knows when, over the letters of a number for example. Everything
/// must be inlined.
void fill_tables(llvm::Function& process, analysis_managers& managers);

/// Computes calls of the C library's mathematics with constants. Refuses those that are left.
void compute_mathematics(llvm::Function& process, analysis_managers& managers);

}  // namespace epiline::frontend
