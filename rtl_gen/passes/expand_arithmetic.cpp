#include "passes/expand_arithmetic.hpp"

#include <algorithm>

#include "passes/builder.hpp"

namespace epiline::passes {

namespace {

// A factor of at most so many bits is worth additions instead of a multiplier.
constexpr unsigned most_adders = 5;

struct quotient_and_remainder {
  node_id quotient;
  node_id remainder;
};

/// Restoring division, highest bit first. A divisor of 0 gives all ones and the dividend, as graph.hpp asks.
quotient_and_remainder divide_unsigned(builder& b, node_id dividend, node_id divisor) {
  const unsigned width = b.width(dividend);
  std::vector<node_id> quotient;
  node_id remainder = none;
  for (unsigned step = 1; step <= width; ++step) {
    // What is left after `step` bits of the dividend has at most `step` bits.
    const node_id bit = b.slice(dividend, width - step, 1);
    const node_id left = remainder == none ? bit : b.concat({remainder, bit});
    const node_id divisor_low = b.slice(divisor, 0, step);
    // One bit more is the borrow: the comparison and the subtraction are one carry chain.
    const node_id difference = b.subtract(b.resize_zero(left, step + 1), b.resize_zero(divisor_low, step + 1));
    node_id fits = b.bit_not(b.slice(difference, step, 1));
    if (step < width) {
      const node_id divisor_high = b.slice(divisor, step, width - step);
      fits = b.bit_and(fits, b.equal(divisor_high, b.constant(width - step, 0)));
    }
    quotient.push_back(fits);
    remainder = b.select(fits, b.slice(difference, 0, step), left);
  }
  return {b.concat(std::move(quotient)), remainder};
}

node_id divide(builder& b, const node& n) {
  const node_id dividend = n.operands[0], divisor = n.operands[1];
  const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
  if (n.kind == operation::divide_unsigned || n.kind == operation::remainder_unsigned) {
    const quotient_and_remainder found = divide_unsigned(b, dividend, divisor);
    return quotient ? found.quotient : found.remainder;
  }
  const node_id dividend_negative = b.slice(dividend, n.width - 1, 1);
  const node_id divisor_negative = b.slice(divisor, n.width - 1, 1);
  const quotient_and_remainder found =
      divide_unsigned(b, b.negate_if(dividend_negative, dividend), b.negate_if(divisor_negative, divisor));
  if (!quotient) return b.negate_if(dividend_negative, found.remainder);
  // The quotient of a division by 0 is all ones, whatever the sign.
  const node_id divisor_is_zero = b.equal(divisor, b.constant(n.width, 0));
  const node_id opposite = b.bit_xor(dividend_negative, divisor_negative);
  return b.negate_if(b.bit_and(opposite, b.bit_not(divisor_is_zero)), found.quotient);
}

/// A factor without the copies of its sign or the zeros above it.
struct factor {
  node_id value;
  bool is_signed;
};

factor significant_part(builder& b, node_id id) {
  if (b.kind(id) == operation::extend_sign) return {b.operand(id, 0), true};
  if (b.kind(id) == operation::extend_zero) return {b.operand(id, 0), false};
  if (b.is_constant(id)) {
    const llvm::APInt value = b.value(id);
    const unsigned with_sign = value.getSignificantBits();
    if (value.isNegative()) return {b.constant(value.trunc(with_sign)), true};
    return {b.constant(value.trunc(std::max(1u, value.getActiveBits()))), false};
  }
  return {id, false};  // modulo 2^width the sign does not matter
}

struct piece {
  node_id value;
  bool is_signed;
  unsigned low;  // its place in the factor
};

/// Pieces of at most `width` bits as signed numbers, lowest first; only the last one can be negative.
std::vector<piece> pieces_of(builder& b, const factor& whole, unsigned width) {
  const unsigned bits = b.width(whole.value);
  std::vector<piece> pieces;
  unsigned low = 0;
  while (bits - low > (whole.is_signed ? width : width - 1)) {
    pieces.push_back({b.slice(whole.value, low, width - 1), false, low});
    low += width - 1;
  }
  pieces.push_back({b.slice(whole.value, low, bits - low), whole.is_signed, low});
  return pieces;
}

node_id extend(builder& b, const piece& p, unsigned width) {
  return p.is_signed ? b.resize_sign(p.value, width) : b.resize_zero(p.value, width);
}

/// A narrow factor's bits choose among multiples of the other factor: a tree of that few adders takes fewer
/// nanoseconds a stage than a multiplier, in which no register can stand.
node_id multiply_by_bits(builder& b, const node& n, const factor& narrow, node_id other) {
  node_id sum = none;
  for (unsigned bit = 0; bit < b.width(narrow.value) && bit < n.width; ++bit) {
    const node_id multiple = b.slice(other, 0, n.width - bit);
    const node_id chosen = b.select(b.slice(narrow.value, bit, 1), multiple, b.constant(n.width - bit, 0));
    const node_id placed = bit == 0 ? chosen : b.concat({chosen, b.constant(bit, 0)});
    sum = sum == none ? placed : b.add(sum, placed);
  }
  return sum;
}

node_id multiply(builder& b, const node& n, unsigned multiplier_width) {
  const factor left_factor = significant_part(b, n.operands[0]);
  const factor right_factor = significant_part(b, n.operands[1]);
  const auto is_narrow = [&](const factor& f) { return !f.is_signed && b.width(f.value) <= most_adders; };
  if (is_narrow(left_factor)) return multiply_by_bits(b, n, left_factor, n.operands[1]);
  if (is_narrow(right_factor)) return multiply_by_bits(b, n, right_factor, n.operands[0]);
  if (multiplier_width == 0) return none;
  const std::vector<piece> left = pieces_of(b, left_factor, multiplier_width);
  const std::vector<piece> right = pieces_of(b, right_factor, multiplier_width);
  if (left.size() == 1 && right.size() == 1) return none;
  node_id sum = none;
  for (const piece& x : left) {
    for (const piece& y : right) {
      const unsigned low = x.low + y.low;
      if (low >= n.width) continue;  // wraps away
      const unsigned room = n.width - low;
      const unsigned width = std::min(room, b.width(x.value) + b.width(y.value));
      const node_id product = b.multiply(extend(b, x, width), extend(b, y, width));
      const node_id wide = extend(b, {product, x.is_signed || y.is_signed, 0}, room);
      const node_id placed = low == 0 ? wide : b.concat({wide, b.constant(low, 0)});
      sum = sum == none ? placed : b.add(sum, placed);
    }
  }
  return sum;
}

}  // namespace

void expand_arithmetic(graph& g, unsigned multiplier_width) {
  rebuild(g, [multiplier_width](builder& b, node n, node_id) {
    node_id result = none;
    if (n.kind >= operation::divide_unsigned && n.kind <= operation::remainder_signed) result = divide(b, n);
    if (n.kind == operation::multiply) result = multiply(b, n, multiplier_width);
    return result != none ? result : b.make(std::move(n));
  });
}

}  // namespace epiline::passes
