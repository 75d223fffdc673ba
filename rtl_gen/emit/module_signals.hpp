#pragma once
// What the names of a module that has been written come from.

#include <vector>

#include "emit/module_text.hpp"
#include "emit/signals.hpp"

namespace epiline::emit {

[[nodiscard]] std::vector<signal> signals_of(const module_text& m);

}  // namespace epiline::emit
