#include "passes/reduce_strength.hpp"

#include "passes/builder.hpp"

namespace epiline::passes {

namespace {

using llvm::APInt;

struct digit {
  unsigned shift;
  bool negative;
};

/// `value` as the sum of fewest powers of two with signs: no two neighbouring digits are set.
std::vector<digit> signed_digits(const APInt& value) {
  std::vector<digit> digits;
  APInt rest = value.sext(value.getBitWidth() + 2);  // room for the carry
  for (unsigned shift = 0; !rest.isZero(); ++shift, rest.ashrInPlace(1)) {
    if (!rest[0]) continue;
    const bool negative = rest[1];  // ...11 is -1 and a carry
    digits.push_back({shift, negative});
    rest += APInt(rest.getBitWidth(), negative ? 1 : -1, true);
  }
  return digits;
}

node_id multiply_by_constant(builder& b, const node& n, unsigned max_terms) {
  const node_id x = n.operands[0];
  std::vector<digit> digits = signed_digits(b.value(n.operands[1]));
  while (!digits.empty() && digits.back().shift >= n.width) digits.pop_back();  // shifted out
  if (digits.size() > max_terms || digits.empty()) return none;
  const auto term = [&](const digit& d) {
    return b.make(operation::shift_left, n.width, {x, b.constant(32, d.shift)});
  };
  // A positive term first, if there is one, so that no negation is needed.
  std::size_t first = 0;
  while (first < digits.size() && digits[first].negative) ++first;
  node_id sum = first < digits.size() ? term(digits[first]) : b.constant(n.width, 0);
  for (std::size_t i = 0; i < digits.size(); ++i)
    if (i != first) sum = digits[i].negative ? b.subtract(sum, term(digits[i])) : b.add(sum, term(digits[i]));
  return sum;
}

/// x / divisor for a constant that is neither 0 nor a power of two: the high part of a product (Granlund, Montgomery,
/// "Division by invariant integers using multiplication", 1994): floor(x * m / 2^s) with s = width + ceil(log2
/// divisor), m = floor(2^s / divisor) + 1 is exact for every x of `width` bits.
node_id quotient_unsigned(builder& b, node_id x, const APInt& divisor) {
  const unsigned width = b.width(x), shift = width + divisor.ceilLogBase2();
  if (divisor.isPowerOf2()) return b.make(operation::divide_unsigned, width, {x, b.constant(divisor)});
  const unsigned wide = width + shift + 1;
  const APInt factor = APInt::getOneBitSet(wide, shift).udiv(divisor.zext(wide)) + 1;
  return b.slice(b.multiply(b.resize_zero(x, wide), b.constant(factor)), shift, width);
}

node_id divide_by_constant(builder& b, const node& n) {
  const node_id x = n.operands[0];
  const APInt divisor = b.value(n.operands[1]);
  const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
  const bool is_signed = n.kind == operation::divide_signed || n.kind == operation::remainder_signed;
  node_id result = none;
  if (is_signed) {  // of magnitudes, and the sign afterwards
    const node_id negative = b.slice(x, n.width - 1, 1);
    const node_id magnitude = b.negate_if(negative, x);
    const node_id unsigned_result = quotient_unsigned(b, magnitude, divisor.abs());
    const node_id opposite = divisor.isNegative() ? b.bit_not(negative) : negative;
    result = b.negate_if(opposite, unsigned_result);
  } else {
    result = quotient_unsigned(b, x, divisor);
  }
  return quotient ? result : b.subtract(x, b.multiply(result, n.operands[1]));
}

}  // namespace

void reduce_strength(graph& g, unsigned max_terms) {
  rebuild(g, [max_terms](builder& b, node n, node_id) {
    const bool constant = n.operands.size() == 2 && b.is_constant(n.operands[1]);
    const bool divides = n.kind >= operation::divide_unsigned && n.kind <= operation::remainder_signed;
    node_id result = none;
    if (constant && divides && !b.is_zero(n.operands[1])) result = divide_by_constant(b, n);
    if (constant && n.kind == operation::multiply) result = multiply_by_constant(b, n, max_terms);
    return result != none ? result : b.make(std::move(n));
  });
}

}  // namespace epiline::passes
