// Rules for comparisons: mostly ways to compare fewer bits.
#include "passes/rules.hpp"

namespace epiline::passes {

namespace {

using llvm::APInt;

bool is_extension(operation kind) { return kind == operation::extend_zero || kind == operation::extend_sign; }

/// Both operands extended the same way: compare the widest of what was extended.
node_id compare_unextended(builder& b, operation compare, operation extension, node_id x, node_id y) {
  if (b.kind(x) != extension || b.kind(y) != extension) return none;
  node_id p = b.operand(x, 0), q = b.operand(y, 0);
  const unsigned width = std::max(b.width(p), b.width(q));
  if (b.width(p) != width) p = b.make(extension, width, {p});
  if (b.width(q) != width) q = b.make(extension, width, {q});
  return b.make(compare, 1, {p, q});
}

node_id equal_to_constant(builder& b, node_id x, const APInt& value) {
  const unsigned width = value.getBitWidth();
  if (width == 1) return value.isOne() ? x : b.bit_not(x);
  switch (b.kind(x)) {
    case operation::bit_not:
      return b.equal(b.operand(x, 0), b.constant(~value));
    case operation::add:  // x + c == d
      if (!b.is_constant(b.operand(x, 1))) return none;
      return b.equal(b.operand(x, 0), b.constant(value - b.value(b.operand(x, 1))));
    case operation::subtract:
      if (value.isZero()) return b.equal(b.operand(x, 0), b.operand(x, 1));
      if (!b.is_constant(b.operand(x, 0))) return none;
      return b.equal(b.operand(x, 1), b.constant(b.value(b.operand(x, 0)) - value));
    case operation::bit_xor:
      return value.isZero() ? b.equal(b.operand(x, 0), b.operand(x, 1)) : none;
    case operation::extend_zero:
    case operation::extend_sign: {
      const node_id inner = b.operand(x, 0);
      const APInt cut = value.trunc(b.width(inner));
      const APInt back = b.kind(x) == operation::extend_zero ? cut.zext(width) : cut.sext(width);
      return back == value ? b.equal(inner, b.constant(cut)) : b.bit(false);
    }
    case operation::concat: {  // constant parts are decided now
      const std::vector<node_id> parts = b.at(x).operands;
      std::vector<node_id> kept;
      APInt rest(1, 0);
      unsigned top = width;
      for (const node_id part : parts) {
        top -= b.width(part);
        const APInt expected = value.extractBits(b.width(part), top);
        if (b.is_constant(part)) {
          if (b.value(part) != expected) return b.bit(false);
          continue;
        }
        rest = kept.empty() ? expected : rest.concat(expected);
        kept.push_back(part);
      }
      if (kept.size() == parts.size()) return none;
      return b.equal(b.concat(std::move(kept)), b.constant(rest));
    }
    case operation::select: {  // select(c, constant, constant) == constant is c, its opposite or a constant
      const node_id c = b.operand(x, 0), one = b.operand(x, 1), zero = b.operand(x, 2);
      if (!b.is_constant(one) || !b.is_constant(zero)) return none;
      return b.select(c, b.bit(b.value(one) == value), b.bit(b.value(zero) == value));
    }
    default:
      return none;
  }
}

node_id is_equal(builder& b, node_id x, const APInt& value) { return b.equal(x, b.constant(value)); }

/// x < limit for a constant limit, unsigned.
node_id below(builder& b, node_id x, const APInt& limit) {
  const unsigned width = limit.getBitWidth();
  if (limit.isZero()) return b.bit(false);
  if (limit.isAllOnes()) return b.bit_not(is_equal(b, x, limit));
  if (limit.isPowerOf2()) {
    const unsigned bits = limit.logBase2();
    return is_equal(b, b.slice(x, bits, width - bits), APInt(width - bits, 0));
  }
  if (b.kind(x) != operation::extend_zero) return none;
  const node_id inner = b.operand(x, 0);
  const unsigned inner_width = b.width(inner);
  if (limit.getActiveBits() > inner_width) return b.bit(true);
  return b.less_unsigned(inner, b.constant(limit.trunc(inner_width)));
}

/// limit < x for a constant limit, unsigned.
node_id above(builder& b, node_id x, const APInt& limit) {
  if (limit.isAllOnes()) return b.bit(false);
  const APInt next = limit + 1;
  if (next.isAllOnes()) return is_equal(b, x, next);
  if (limit.isZero() || next.isPowerOf2()) return b.bit_not(b.less_unsigned(x, b.constant(next)));
  if (b.kind(x) != operation::extend_zero) return none;
  const node_id inner = b.operand(x, 0);
  const unsigned inner_width = b.width(inner);
  if (limit.getActiveBits() > inner_width) return b.bit(false);
  return b.less_unsigned(b.constant(limit.trunc(inner_width)), inner);
}

/// less_signed against a constant; `constant_left`: value < x, otherwise x < value.
node_id less_signed_constant(builder& b, node_id x, const APInt& value, bool constant_left) {
  const unsigned width = value.getBitWidth();
  const APInt least = APInt::getSignedMinValue(width), most = APInt::getSignedMaxValue(width);
  const auto sign = [&] { return b.slice(x, width - 1, 1); };
  if (constant_left) {
    if (value == most) return b.bit(false);
    if (value == least) return b.bit_not(is_equal(b, x, least));
    if (value.isAllOnes()) return b.bit_not(sign());
    if (value + 1 == most) return is_equal(b, x, most);
  } else {
    if (value == least) return b.bit(false);
    if (value == most) return b.bit_not(is_equal(b, x, most));
    if (value.isZero()) return sign();
    if (value - 1 == least) return is_equal(b, x, least);
  }
  if (!is_extension(b.kind(x))) return none;
  const node_id inner = b.operand(x, 0);
  const unsigned inner_width = b.width(inner);
  if (b.kind(x) == operation::extend_zero) {
    if (value.isNegative()) return b.bit(constant_left);
    const node_id limit = b.constant(value);
    return constant_left ? b.less_unsigned(limit, x) : b.less_unsigned(x, limit);
  }
  if (value.getSignificantBits() > inner_width) return b.bit(value.isNegative() == constant_left);
  const node_id cut = b.constant(value.trunc(inner_width));
  return constant_left ? b.make(operation::less_signed, 1, {cut, inner})
                       : b.make(operation::less_signed, 1, {inner, cut});
}

}  // namespace

node_id simplify_equal(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  if (x == y) return b.bit(true);
  if (b.is_constant(y)) return equal_to_constant(b, x, b.value(y));
  if (b.width(x) == 1) return b.bit_not(b.bit_xor(x, y));
  for (const operation extension : {operation::extend_zero, operation::extend_sign})
    if (const node_id narrower = compare_unextended(b, n.kind, extension, x, y); narrower != none) return narrower;
  return none;
}

node_id simplify_less(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  const bool is_signed = n.kind == operation::less_signed;
  if (x == y) return b.bit(false);
  if (b.width(x) == 1) return is_signed ? b.bit_and(x, b.bit_not(y)) : b.bit_and(b.bit_not(x), y);
  if (b.is_constant(y)) return is_signed ? less_signed_constant(b, x, b.value(y), false) : below(b, x, b.value(y));
  if (b.is_constant(x)) return is_signed ? less_signed_constant(b, y, b.value(x), true) : above(b, y, b.value(x));
  // Two zero extended values have no sign; two values extended alike compare as before the extension.
  if (const node_id narrower = compare_unextended(b, operation::less_unsigned, operation::extend_zero, x, y);
      narrower != none)
    return narrower;
  return compare_unextended(b, n.kind, operation::extend_sign, x, y);
}

node_id apply_rules(builder& b, const node& n) {
  switch (n.kind) {
    case operation::slice:
      return simplify_slice(b, n);
    case operation::concat:
      return simplify_concat(b, n);
    case operation::extend_zero:
    case operation::extend_sign:
      return simplify_extension(b, n);
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return simplify_shift(b, n);
    case operation::table:
      return simplify_table(b, n);
    case operation::bit_and:
    case operation::bit_or:
    case operation::bit_xor:
      return simplify_bitwise(b, n);
    case operation::bit_not:
      return simplify_not(b, n);
    case operation::select:
      return simplify_select(b, n);
    case operation::add:
      return simplify_add(b, n);
    case operation::subtract:
      return simplify_subtract(b, n);
    case operation::multiply:
      return simplify_multiply(b, n);
    case operation::divide_unsigned:
    case operation::divide_signed:
    case operation::remainder_unsigned:
    case operation::remainder_signed:
      return simplify_division(b, n);
    case operation::equal:
      return simplify_equal(b, n);
    case operation::less_unsigned:
    case operation::less_signed:
      return simplify_less(b, n);
    default:
      return none;
  }
}

}  // namespace epiline::passes
