#pragma once

#include "frontend/lower.hpp"

namespace epiline::frontend {

/// Splits every variable into its scalars, once constant loops are unrolled. A scalar reached by constant indices only
/// becomes an SSA value; an array dimension indexed at run time becomes
///   - multiplexed registers, when it is small or partitioned by #pragma HLS ARRAY_PARTITION complete;
///   - the address of a memory (or, for constants, of a table) otherwise.
/// Appends the memories and tables to `result`; accesses to them become the calls of vocabulary.hpp.
/// Refuses pointers chosen at run time, addresses that escape and type punning.
void split_aggregates(lowered_process& result);

/// The largest array indexed at run time that becomes multiplexed registers by itself.
inline constexpr unsigned largest_register_array = 16;

}  // namespace epiline::frontend
