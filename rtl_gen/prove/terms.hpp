#pragma once
// Small helpers between LLVM's numbers, the sets of the passes' analyses and Z3's bit-vector terms.

#include <llvm/ADT/APInt.h>
#include <z3++.h>

#include "passes/value_set.hpp"

namespace epiline::prove {

[[nodiscard]] z3::expr constant_term(z3::context& solver, const llvm::APInt& value);

/// The value of a bit-vector term in a model; what the model leaves open is 0.
[[nodiscard]] llvm::APInt value_of(const z3::model& model, const z3::expr& term);

/// Cuts or widens with zeros.
[[nodiscard]] z3::expr resized(const z3::expr& term, unsigned width);

/// Bits [low, low + width).
[[nodiscard]] z3::expr bits_of(const z3::expr& term, unsigned low, unsigned width);

/// A term of one bit as a truth value, and back.
[[nodiscard]] z3::expr is_one(const z3::expr& bit);
[[nodiscard]] z3::expr as_bit(const z3::expr& condition);

/// That a value lies in a set.
[[nodiscard]] z3::expr lies_in(const z3::expr& term, const passes::value_set& set);

/// Whether that says anything: some value of the width is not in the set.
[[nodiscard]] bool is_restrictive(const passes::value_set& set);

}  // namespace epiline::prove
