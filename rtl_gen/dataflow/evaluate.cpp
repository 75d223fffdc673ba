#include "dataflow/evaluate.hpp"

#include <stdexcept>

namespace epiline::dataflow {

namespace {

llvm::APInt bit(bool value) { return llvm::APInt(1, value ? 1 : 0); }

llvm::APInt divide(operation kind, const llvm::APInt& a, const llvm::APInt& b) {
  const bool quotient = kind == operation::divide_unsigned || kind == operation::divide_signed;
  if (b.isZero()) return quotient ? llvm::APInt::getAllOnes(a.getBitWidth()) : a;
  switch (kind) {
    case operation::divide_unsigned:
      return a.udiv(b);
    case operation::divide_signed:
      return a.sdiv(b);
    case operation::remainder_unsigned:
      return a.urem(b);
    default:
      return a.srem(b);
  }
}

}  // namespace

bool is_pure(operation kind) { return kind >= operation::add || kind == operation::constant; }

llvm::APInt evaluate(operation kind, unsigned width, unsigned low, std::span<const llvm::APInt> operands) {
  const llvm::APInt& a = operands[0];
  switch (kind) {
    case operation::add:
      return a + operands[1];
    case operation::subtract:
      return a - operands[1];
    case operation::multiply:
      return a * operands[1];
    case operation::add_or_subtract:
      return operands[2].isZero() ? a + operands[1] : a - operands[1];
    case operation::divide_unsigned:
    case operation::divide_signed:
    case operation::remainder_unsigned:
    case operation::remainder_signed:
      return divide(kind, a, operands[1]);
    case operation::bit_and:
      return a & operands[1];
    case operation::bit_or:
      return a | operands[1];
    case operation::bit_xor:
      return a ^ operands[1];
    case operation::bit_not:
      return ~a;
    // APInt clamps an amount of another width to its own range: at least the width shifts everything out.
    case operation::shift_left:
      return a.shl(static_cast<unsigned>(operands[1].getLimitedValue(width)));
    case operation::shift_right_logical:
      return a.lshr(static_cast<unsigned>(operands[1].getLimitedValue(width)));
    case operation::shift_right_arithmetic:
      return a.ashr(static_cast<unsigned>(operands[1].getLimitedValue(width)));
    case operation::equal:
      return bit(a == operands[1]);
    case operation::less_unsigned:
      return bit(a.ult(operands[1]));
    case operation::less_signed:
      return bit(a.slt(operands[1]));
    case operation::select:
      return a.isZero() ? operands[2] : operands[1];
    case operation::concat: {
      llvm::APInt result(width, 0);
      unsigned position = width;
      for (const llvm::APInt& operand : operands) {
        position -= operand.getBitWidth();
        result.insertBits(operand, position);
      }
      return result;
    }
    case operation::slice:
      return a.extractBits(width, low);
    case operation::extend_zero:
      return a.zext(width);
    case operation::extend_sign:
      return a.sext(width);
    default:
      throw std::invalid_argument("evaluate: not a pure operation");
  }
}

}  // namespace epiline::dataflow
