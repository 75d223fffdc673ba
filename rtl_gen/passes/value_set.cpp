#include "passes/value_set.hpp"

#include <algorithm>

namespace epiline::passes {

using dataflow::node;
using dataflow::operation;
using llvm::APInt;
using llvm::CmpInst;
using llvm::ConstantRange;
using llvm::KnownBits;

unsigned value_set::unsigned_bits() const {
  return std::max(1u, std::min(bits.countMaxActiveBits(), range.getActiveBits()));
}

unsigned value_set::signed_bits() const {
  return std::max(1u, std::min(bits.countMaxSignificantBits(), range.getMinSignedBits()));
}

APInt value_set::without_implied(APInt demanded) const {
  const unsigned zero = unsigned_bits(), sign = signed_bits();
  const unsigned kept = std::min(zero, sign);
  if (demanded.getActiveBits() <= kept) return demanded;
  demanded.clearHighBits(width() - kept);
  if (sign < zero) demanded.setBit(sign - 1);
  return demanded;
}

bool value_set::contains_zero() const { return bits.One.isZero() && range.contains(APInt(width(), 0)); }

bool value_set::join(const value_set& other) {
  const KnownBits joined_bits = bits.intersectWith(other.bits);
  const ConstantRange joined_range = range.unionWith(other.range);
  const bool changed = joined_bits != bits || joined_range != range;
  bits = joined_bits;
  range = joined_range;
  return changed;
}

void value_set::meet(const value_set& other) {
  const ConstantRange common = range.intersectWith(other.range);
  const KnownBits both = bits.unionWith(other.bits);
  if (common.isEmptySet() || both.hasConflict()) return;
  range = common;
  bits = both;
  settle();
}

void value_set::settle() {
  if (width() > max_range_width) {
    range = bits.isConstant() ? ConstantRange(bits.getConstant()) : ConstantRange::getFull(width());
    return;
  }
  const ConstantRange from_bits = ConstantRange::fromKnownBits(bits, false);
  const ConstantRange common = range.intersectWith(from_bits);
  if (!common.isEmptySet()) range = common;
  const KnownBits both = bits.unionWith(range.toKnownBits());
  if (!both.hasConflict()) bits = both;
}

namespace {

KnownBits bits_of(const node& n, llvm::ArrayRef<const value_set*> operands) {
  const KnownBits& a = operands[0]->bits;
  const auto b = [&]() -> const KnownBits& { return operands[1]->bits; };
  // LLVM's shifts take an amount of the value's width; one that does not fit means everything is shifted out.
  const auto amount = [&] {
    if (b().getBitWidth() <= n.width) return b().zext(n.width);
    return b().getMaxValue().ult(n.width) ? b().trunc(n.width) : KnownBits(n.width);
  };
  const auto shift = [&](auto compute) {
    const KnownBits by = amount();
    return by.getMaxValue().ult(n.width) ? compute(a, by) : KnownBits(n.width);
  };
  const auto truth = [](std::optional<bool> known) {
    return known ? KnownBits::makeConstant(APInt(1, *known ? 1 : 0)) : KnownBits(1);
  };
  switch (n.kind) {
    case operation::add:
      return KnownBits::computeForAddSub(true, false, false, a, b());
    case operation::subtract:
      return KnownBits::computeForAddSub(false, false, false, a, b());
    case operation::multiply:
      return KnownBits::mul(a, b());
    case operation::bit_and:
      return a & b();
    case operation::bit_or:
      return a | b();
    case operation::bit_xor:
      return a ^ b();
    case operation::bit_not: {
      KnownBits result = a;
      std::swap(result.Zero, result.One);
      return result;
    }
    case operation::shift_left:
      return shift([](const KnownBits& x, const KnownBits& by) { return KnownBits::shl(x, by); });
    case operation::shift_right_logical:
      return shift([](const KnownBits& x, const KnownBits& by) { return KnownBits::lshr(x, by); });
    case operation::shift_right_arithmetic:
      return shift([](const KnownBits& x, const KnownBits& by) { return KnownBits::ashr(x, by); });
    case operation::equal:
      return truth(KnownBits::eq(a, b()));
    case operation::less_unsigned:
      return truth(KnownBits::ult(a, b()));
    case operation::less_signed:
      return truth(KnownBits::slt(a, b()));
    case operation::select:
      return b().intersectWith(operands[2]->bits);
    case operation::concat: {
      KnownBits result = a;
      for (std::size_t i = 1; i < operands.size(); ++i) result = result.concat(operands[i]->bits);
      return result;
    }
    case operation::slice:
      return a.extractBits(n.width, n.low);
    case operation::extend_zero:
      return a.zext(n.width);
    case operation::extend_sign:
      return a.sext(n.width);
    default:
      return KnownBits(n.width);
  }
}

ConstantRange range_of(const node& n, llvm::ArrayRef<const value_set*> operands) {
  const ConstantRange& a = operands[0]->range;
  const auto b = [&]() -> const ConstantRange& { return operands[1]->range; };
  const auto may_be_zero = [&] { return b().contains(APInt(n.width, 0)); };  // division by zero has rules of its own
  const auto may_overflow = [&] {                                            // least / -1 wraps
    return a.contains(APInt::getSignedMinValue(n.width)) && b().contains(APInt::getAllOnes(n.width));
  };
  const auto truth = [&](CmpInst::Predicate yes) {
    if (a.icmp(yes, b())) return ConstantRange(APInt(1, 1));
    if (a.icmp(CmpInst::getInversePredicate(yes), b())) return ConstantRange(APInt(1, 0));
    return ConstantRange::getFull(1);
  };
  // An amount below the width means the same at the value's width; others are left to the known bits.
  const auto amount = [&] {
    return b().getUnsignedMax().ult(n.width) ? b().zextOrTrunc(n.width) : ConstantRange::getFull(n.width);
  };
  switch (n.kind) {
    case operation::add:
      return a.add(b());
    case operation::subtract:
      return a.sub(b());
    case operation::multiply:
      return a.multiply(b());
    case operation::divide_unsigned:
      return may_be_zero() ? ConstantRange::getFull(n.width) : a.udiv(b());
    case operation::divide_signed:
      return may_be_zero() || may_overflow() ? ConstantRange::getFull(n.width) : a.sdiv(b());
    case operation::remainder_unsigned:
      return may_be_zero() ? a.unionWith(ConstantRange::getNonEmpty(APInt(n.width, 0), a.getUnsignedMax() + 1))
                           : a.urem(b());
    case operation::remainder_signed:
      return may_be_zero() || may_overflow() ? ConstantRange::getFull(n.width) : a.srem(b());
    case operation::bit_and:
      return a.binaryAnd(b());
    case operation::bit_or:
      return a.binaryOr(b());
    case operation::bit_xor:
      return a.binaryXor(b());
    case operation::bit_not:
      return a.binaryNot();
    case operation::shift_left:
      return amount().isFullSet() ? amount() : a.shl(amount());
    case operation::shift_right_logical:
      return ConstantRange::getNonEmpty(APInt(n.width, 0), a.lshr(amount()).getUnsignedMax() + 1);
    case operation::shift_right_arithmetic:
      return amount().isFullSet() ? amount() : a.ashr(amount());
    case operation::equal:
      return truth(CmpInst::ICMP_EQ);
    case operation::less_unsigned:
      return truth(CmpInst::ICMP_ULT);
    case operation::less_signed:
      return truth(CmpInst::ICMP_SLT);
    case operation::select:
      return b().unionWith(operands[2]->range);
    case operation::slice:
      return n.low == 0 ? a.truncate(n.width) : a.lshr(ConstantRange(APInt(a.getBitWidth(), n.low))).truncate(n.width);
    case operation::extend_zero:
      return a.zeroExtend(n.width);
    case operation::extend_sign:
      return a.signExtend(n.width);
    case operation::concat: {
      ConstantRange result = a.zeroExtend(n.width);
      if (operands.size() > 2) return ConstantRange::getFull(n.width);
      return result.shl(ConstantRange(APInt(n.width, b().getBitWidth()))).add(b().zeroExtend(n.width));
    }
    default:
      return ConstantRange::getFull(n.width);
  }
}

}  // namespace

value_set evaluate_sets(const node& n, llvm::ArrayRef<const value_set*> operands) {
  value_set result(n.width);
  result.bits = bits_of(n, operands);
  if (result.bits.hasConflict()) result.bits.resetAll();
  const auto is_narrow = [](const value_set* set) { return set->width() <= max_range_width; };
  if (n.width > max_range_width || !std::all_of(operands.begin(), operands.end(), is_narrow)) return result;
  const ConstantRange range = range_of(n, operands);
  if (!range.isEmptySet()) result.range = range;
  return result;
}

}  // namespace epiline::passes
