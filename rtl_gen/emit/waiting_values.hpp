#pragma once
// What stands in flip-flops and delay lines at the start of a stage because an earlier stage made it.

#include "emit/module_text.hpp"

namespace epiline::emit {

void write_waiting_values(module_text& m, int stage);

}  // namespace epiline::emit
