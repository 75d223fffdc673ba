#pragma once
// Sets of bit vectors, as an analysis tracks them, and what operations do to them.

#include <llvm/ADT/ArrayRef.h>
#include <llvm/IR/ConstantRange.h>
#include <llvm/Support/KnownBits.h>

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Ranges are kept for values up to this width; wider ones (packed words) are tracked by bits only.
inline constexpr unsigned max_range_width = 128;

/// A set of values: those that agree with `bits` and lie in `range` (which may wrap around, so it serves values with
/// and without a sign).
struct value_set {
  llvm::KnownBits bits;
  llvm::ConstantRange range;

  explicit value_set(unsigned width) : bits(width), range(width, true) {}
  explicit value_set(const llvm::APInt& value) : bits(llvm::KnownBits::makeConstant(value)), range(value) {}

  [[nodiscard]] bool operator==(const value_set& other) const { return bits == other.bits && range == other.range; }
  [[nodiscard]] unsigned width() const { return bits.getBitWidth(); }
  [[nodiscard]] bool is_single() const { return bits.isConstant(); }
  /// Fewest low bits from which zero (sign) extension restores every value of the set; at least 1.
  [[nodiscard]] unsigned unsigned_bits() const;
  [[nodiscard]] unsigned signed_bits() const;
  [[nodiscard]] bool contains_zero() const;
  /// Of `demanded` bits those from which the others follow: no known zeros above unsigned_bits(), and if that takes
  /// fewer bits, the lowest copy of the sign instead of all copies.
  [[nodiscard]] llvm::APInt without_implied(llvm::APInt demanded) const;

  /// Widens to contain `other` too. True when that changed the set.
  bool join(const value_set& other);
  /// Keeps what is in both. Contradictions (code that is never reached) leave this set as it was.
  void meet(const value_set& other);
  /// Lets bits and range sharpen each other.
  void settle();
};

/// All results a pure operation other than `constant` can have on operands from these sets (a superset).
[[nodiscard]] value_set evaluate_sets(const dataflow::node& n, llvm::ArrayRef<const value_set*> operands);

}  // namespace epiline::passes
