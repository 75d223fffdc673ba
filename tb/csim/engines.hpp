#pragma once

#include "eval/engine.hpp"

namespace epiline::csim {

/// Adds engine `native`, the top as ordinary C++, for every design that has one.
void register_engines(eval::engine_registry& registry);

}  // namespace epiline::csim
