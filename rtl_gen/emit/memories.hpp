#pragma once
// RAMs and tables: declarations and contents, their ports, and the addresses of delay lines.

#include "emit/module_text.hpp"

namespace epiline::emit {

void write_memory_declarations(module_text& m);
void write_delay_pointers(module_text& m);
/// The read ports of block RAMs whose address is known in `stage`: the word leaves the RAM a clock later and its
/// register another clock later.
void write_block_reads(module_text& m, int stage);
void write_memory_writes(module_text& m, int stage);

}  // namespace epiline::emit
