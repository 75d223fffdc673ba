#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Makes whether a token is read a register, known before the iteration begins: the iteration before computes it from
/// the state it leaves behind. The decision to issue an iteration waits for its tokens, and most of the control hangs
/// on that decision, so no gate is to stand between the state and it.
///
/// Done where the predicate depends on registers alone, all of them with known values after a reset; elsewhere nothing
/// changes. A predicate that is a register already stays as it is. Returns whether anything changed.
bool foresee_reads(dataflow::graph& g);

}  // namespace epiline::passes
