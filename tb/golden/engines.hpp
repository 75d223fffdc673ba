#pragma once

#include "eval/engine.hpp"

namespace epiline::golden {

/// Adds engine `golden` for every design that has a reference model.
void register_engines(eval::engine_registry& registry);

}  // namespace epiline::golden
