// Rules for sums, products and quotients. Expensive expansions (products and quotients by constants) are not here but
// in reduce_strength.hpp, which runs once widths are minimal.
#include "passes/rules.hpp"

namespace epiline::passes {

namespace {

/// Constant zeros at the low end of a value.
unsigned zeros_below(const builder& b, node_id id) {
  if (b.is_constant(id)) return std::min(b.at(id).value.countr_zero(), b.width(id));
  if (b.kind(id) == operation::extend_zero || b.kind(id) == operation::extend_sign) {
    const node_id a = b.operand(id, 0);
    const unsigned zeros = zeros_below(b, a);
    return zeros == b.width(a) ? b.width(id) : zeros;
  }
  if (b.kind(id) != operation::concat) return 0;
  const node_id last = b.at(id).operands.back();
  return b.is_zero(last) ? b.width(last) : 0;
}

/// a + b or a - b where the low bits of b are zero: those of the result are a's.
node_id skip_low_zeros(builder& b, operation kind, node_id x, node_id y) {
  const unsigned width = b.width(x), zeros = zeros_below(b, y);
  if (zeros == 0 || zeros >= width) return none;
  const node_id high =
      b.make(kind, width - zeros, {b.slice(x, zeros, width - zeros), b.slice(y, zeros, width - zeros)});
  return b.concat({high, b.slice(x, 0, zeros)});
}

bool is_negation(const builder& b, node_id id) {
  return b.kind(id) == operation::subtract && b.is_zero(b.operand(id, 0));
}

}  // namespace

node_id simplify_add(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  if (n.width == 1) return b.bit_xor(x, y);
  if (b.is_zero(y)) return x;
  if (x == y) return b.concat({b.slice(x, 0, n.width - 1), b.bit(false)});
  if (is_negation(b, y)) return b.subtract(x, b.operand(y, 1));
  if (is_negation(b, x)) return b.subtract(y, b.operand(x, 1));
  if (b.kind(x) == operation::subtract && b.operand(x, 1) == y) return b.operand(x, 0);
  if (b.kind(y) == operation::subtract && b.operand(y, 1) == x) return b.operand(y, 0);
  if (b.is_constant(y)) {  // constants meet: (x + c) + d, (c - x) + d
    if (b.kind(x) == operation::add && b.is_constant(b.operand(x, 1)))
      return b.add(b.operand(x, 0), b.constant(b.value(b.operand(x, 1)) + b.value(y)));
    if (b.kind(x) == operation::subtract && b.is_constant(b.operand(x, 0)))
      return b.subtract(b.constant(b.value(b.operand(x, 0)) + b.value(y)), b.operand(x, 1));
  }
  if (const node_id shorter = skip_low_zeros(b, operation::add, x, y); shorter != none) return shorter;
  return skip_low_zeros(b, operation::add, y, x);
}

node_id simplify_subtract(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  if (n.width == 1) return b.bit_xor(x, y);
  if (x == y) return b.constant(n.width, 0);
  if (b.is_constant(y)) return b.add(x, b.constant(-b.value(y)));
  if (is_negation(b, y)) return b.add(x, b.operand(y, 1));
  if (b.kind(x) == operation::add && b.operand(x, 0) == y) return b.operand(x, 1);
  if (b.kind(x) == operation::add && b.operand(x, 1) == y) return b.operand(x, 0);
  if (b.is_zero(x) && b.kind(y) == operation::subtract) return b.subtract(b.operand(y, 1), b.operand(y, 0));
  if (b.is_constant(x) && b.kind(y) == operation::add && b.is_constant(b.operand(y, 1)))
    return b.subtract(b.constant(b.value(x) - b.value(b.operand(y, 1))), b.operand(y, 0));
  if (b.is_ones(x)) return b.bit_not(y);
  return skip_low_zeros(b, operation::subtract, x, y);
}

node_id simplify_multiply(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  if (n.width == 1) return b.bit_and(x, y);
  if (b.is_constant(y)) {
    const llvm::APInt factor = b.value(y);
    if (factor.isZero()) return y;
    if (factor.isOne()) return x;
    if (factor.isAllOnes()) return b.subtract(b.constant(n.width, 0), x);
    if (b.kind(x) == operation::multiply && b.is_constant(b.operand(x, 1)))
      return b.multiply(b.operand(x, 0), b.constant(b.value(b.operand(x, 1)) * factor));
  }
  // Zeros below either factor are zeros below the product.
  const unsigned zeros = std::min(n.width, zeros_below(b, x) + zeros_below(b, y));
  if (zeros == 0) return none;
  if (zeros == n.width) return b.constant(n.width, 0);
  const unsigned width = n.width - zeros;
  const auto without_zeros = [&](node_id id) {
    const unsigned low = zeros_below(b, id);
    return b.slice(id, low, width);  // the bits above wrap away
  };
  const node_id p = without_zeros(x);
  return b.concat({b.multiply(p, without_zeros(y)), b.constant(zeros, 0)});
}

node_id simplify_division(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
  const bool is_signed = n.kind == operation::divide_signed || n.kind == operation::remainder_signed;
  if (!b.is_constant(y)) return none;
  const llvm::APInt divisor = b.value(y);
  if (divisor.isZero()) return quotient ? b.constant(llvm::APInt::getAllOnes(n.width)) : x;
  if (divisor.isOne() && !(is_signed && n.width == 1)) return quotient ? x : b.constant(n.width, 0);
  if (is_signed && divisor.isAllOnes())
    return quotient ? b.subtract(b.constant(n.width, 0), x) : b.constant(n.width, 0);
  if (is_signed || !divisor.isPowerOf2()) return none;
  const unsigned bits = divisor.logBase2();
  return quotient ? b.resize_zero(b.slice(x, bits, n.width - bits), n.width)
                  : b.resize_zero(b.slice(x, 0, bits), n.width);
}

}  // namespace epiline::passes
