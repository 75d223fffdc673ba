#pragma once
// What is computed: a wire with the expression of each operation that is not part of its user's text.

#include "emit/module_text.hpp"

namespace epiline::emit {

/// Values that change only while no iteration is in flight, and their registers.
void write_settled(module_text& m);
void write_logic(module_text& m, int stage);

}  // namespace epiline::emit
