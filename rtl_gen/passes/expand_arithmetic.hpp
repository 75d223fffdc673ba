#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Replaces what is too long for a clock by steps between which there can be registers:
/// - Divisions and remainders of two variables: one subtraction and one selection a quotient bit (restoring division),
///   as many steps as the dividend has bits.
/// - Products whose factors are wider than a multiplier of the target, `multiplier_width` bits with sign: a product for
///   every pair of pieces of the factors, and their sum. 0: the target has no multipliers, such products stay.
/// - Products with a factor of a few bits: a sum of as many multiples of the other factor.
///
/// What is known about widths (narrow_widths.hpp) should be there already, divisions by constants should be gone
/// (reduce_strength.hpp).
void expand_arithmetic(dataflow::graph& g, unsigned multiplier_width);

}  // namespace epiline::passes
