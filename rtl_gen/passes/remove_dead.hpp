#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Removes nodes, registers, memories and tables no output depends on. Reads of input ports stay: taking a token is an
/// effect. Ports stay: they are the interface. Registers, memories and tables are renumbered in their order. A
/// `patient` mark goes when no patient register is left.
void remove_dead(dataflow::graph& g);

}  // namespace epiline::passes
