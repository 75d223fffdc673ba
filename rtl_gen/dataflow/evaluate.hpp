#pragma once
// What each pure operation computes, on arbitrary-precision values: the definition the passes fold constants with and
// the interpreter falls back to for wide operands.

#include <llvm/ADT/APInt.h>

#include <span>

#include "dataflow/graph.hpp"

namespace epiline::dataflow {

/// True for operations whose result is a function of their operands alone (no port, register, memory or table).
[[nodiscard]] bool is_pure(operation kind);

/// The result of a pure operation other than `constant` on operand values of the widths graph.hpp demands.
/// `width` is the result's, `low` the slice's lowest bit.
[[nodiscard]] llvm::APInt evaluate(operation kind, unsigned width, unsigned low, std::span<const llvm::APInt> operands);

}  // namespace epiline::dataflow
