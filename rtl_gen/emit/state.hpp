#pragma once
// The registers of the source: their declarations, and what they take over at a stage's end.

#include "dataflow/graph.hpp"
#include "emit/module_text.hpp"

namespace epiline::emit {

void declare_register(module_text& m, dataflow::register_id r);
void write_state(module_text& m, int stage);

}  // namespace epiline::emit
