#pragma once
// The ports: buffers behind the inputs, the registers of arguments, FIFOs in front of the outputs.

#include "emit/module_text.hpp"

namespace epiline::emit {

/// Declares what the issue asks the outputs' FIFOs for.
void write_credits(module_text& m);
void write_inputs(module_text& m);
void write_outputs(module_text& m);

}  // namespace epiline::emit
