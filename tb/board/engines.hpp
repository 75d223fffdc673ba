#pragma once
// The engine `board`: a design in a real device, at the other end of a serial port.

#include "eval/engine.hpp"

namespace epiline::board {

/// Adds the engine `board` to every design. It takes the port and its rate from the options of the run.
void register_engines(eval::engine_registry& registry);

}  // namespace epiline::board
