// What LLVM's instructions are in the dataflow graph.

#include <fmt/format.h>
#include <llvm/IR/IntrinsicInst.h>

#include "frontend/step_values.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

using dataflow::node_id;
using dataflow::operation;
using llvm::BasicBlock;
using llvm::Instruction;

namespace {

[[noreturn]] void refuse_instruction(const Instruction& at) {
  const source_place place = place_of(at);
  if (at.getType()->isFloatingPointTy() ||
      (at.getNumOperands() != 0 && at.getOperand(0)->getType()->isFloatingPointTy()))
    refuse(place, "floating point arithmetic: use ap_int/ap_uint (fixed point) instead");
  if (at.getType()->isPointerTy() || llvm::isa<llvm::LoadInst>(at) || llvm::isa<llvm::StoreInst>(at))
    refuse(place, "a pointer that is not known at compile time: use array indices");
  const auto* call = llvm::dyn_cast<llvm::CallInst>(&at);
  const bool is_named = call != nullptr && call->getCalledFunction() != nullptr;
  refuse(place, fmt::format("'{}' has no hardware form here",
                            is_named ? call->getCalledFunction()->getName().str() : at.getOpcodeName()));
}

}  // namespace

node_id step_values::translate(const Instruction& at) {
  const BasicBlock* block = at.getParent();
  const auto operand = [&](unsigned i) { return use(at.getOperand(i), block); };
  const unsigned width = at.getType()->isIntegerTy() ? at.getType()->getIntegerBitWidth() : 0;
  if (width == 0) refuse_instruction(at);
  const auto binary = [&](operation kind) { return nodes_.add(kind, width, {operand(0), operand(1)}); };
  switch (at.getOpcode()) {
    case Instruction::Add:
      return binary(operation::add);
    case Instruction::Sub:
      return binary(operation::subtract);
    case Instruction::Mul:
      return binary(operation::multiply);
    case Instruction::UDiv:
      return binary(operation::divide_unsigned);
    case Instruction::SDiv:
      return binary(operation::divide_signed);
    case Instruction::URem:
      return binary(operation::remainder_unsigned);
    case Instruction::SRem:
      return binary(operation::remainder_signed);
    case Instruction::And:
      return binary(operation::bit_and);
    case Instruction::Or:
      return binary(operation::bit_or);
    case Instruction::Xor:
      return binary(operation::bit_xor);
    case Instruction::Shl:
      return binary(operation::shift_left);
    case Instruction::LShr:
      return binary(operation::shift_right_logical);
    case Instruction::AShr:
      return binary(operation::shift_right_arithmetic);
    case Instruction::ZExt:
      return nodes_.add(operation::extend_zero, width, {operand(0)});
    case Instruction::SExt:
      return nodes_.add(operation::extend_sign, width, {operand(0)});
    case Instruction::Trunc:
      return nodes_.add(operation::slice, width, {operand(0)});
    case Instruction::Freeze:
      return operand(0);
    case Instruction::Select:
      return nodes_.choose(operand(0), operand(1), operand(2));
    case Instruction::ICmp:
      return compare(llvm::cast<llvm::ICmpInst>(at));
    case Instruction::PHI:
      return join(llvm::cast<llvm::PHINode>(at));
    case Instruction::Call:
      return call(llvm::cast<llvm::CallInst>(at));
    default:
      refuse_instruction(at);
  }
}

node_id step_values::compare(const llvm::ICmpInst& at) {
  const BasicBlock* block = at.getParent();
  if (!at.getOperand(0)->getType()->isIntegerTy()) refuse_instruction(at);
  const node_id a = use(at.getOperand(0), block);
  const node_id b = use(at.getOperand(1), block);
  const auto negated = [&](operation kind, node_id one, node_id other) {
    return nodes_.inverse(nodes_.add(kind, 1, {one, other}));
  };
  switch (at.getPredicate()) {
    case llvm::CmpInst::ICMP_EQ:
      return nodes_.add(operation::equal, 1, {a, b});
    case llvm::CmpInst::ICMP_NE:
      return negated(operation::equal, a, b);
    case llvm::CmpInst::ICMP_ULT:
      return nodes_.add(operation::less_unsigned, 1, {a, b});
    case llvm::CmpInst::ICMP_UGT:
      return nodes_.add(operation::less_unsigned, 1, {b, a});
    case llvm::CmpInst::ICMP_UGE:
      return negated(operation::less_unsigned, a, b);
    case llvm::CmpInst::ICMP_ULE:
      return negated(operation::less_unsigned, b, a);
    case llvm::CmpInst::ICMP_SLT:
      return nodes_.add(operation::less_signed, 1, {a, b});
    case llvm::CmpInst::ICMP_SGT:
      return nodes_.add(operation::less_signed, 1, {b, a});
    case llvm::CmpInst::ICMP_SGE:
      return negated(operation::less_signed, a, b);
    default:
      return negated(operation::less_signed, b, a);
  }
}

node_id step_values::call(const llvm::CallInst& at) {
  if (access_of(at) == access::read) {
    read_tokens(object_of(at));
    return translated_.at(&at);
  }
  if (access_of(at) == access::memory_read) return memory_read(at);
  // Where two ways meet, one of them from the function's entry: no step takes that one, the register begins with it.
  if (const llvm::Constant* number = power_up_value(&at); number != nullptr && start_.is_folded())
    return nodes_.constant(llvm::cast<llvm::ConstantInt>(number)->getValue());
  const BasicBlock* block = at.getParent();
  const unsigned width = at.getType()->getIntegerBitWidth();
  if (access_of(at) == access::table) {
    const node_id address =
        nodes_.in_address_width(use(at.getArgOperand(1), block), graph_.tables[object_of(at)].values.size());
    const node_id made = nodes_.add(operation::table, width, {address});
    nodes_[made].object = object_of(at);
    return made;
  }
  const auto operand = [&](unsigned i) { return use(at.getArgOperand(i), block); };
  const auto minimum = [&](operation less, bool maximum) {
    const node_id a = operand(0);
    const node_id b = operand(1);
    const node_id first = nodes_.add(less, 1, {a, b});
    return maximum ? nodes_.choose(first, b, a) : nodes_.choose(first, a, b);
  };
  const node_id zero = nodes_.constant(width, 0);
  switch (at.getIntrinsicID()) {
    case llvm::Intrinsic::umin:
      return minimum(operation::less_unsigned, false);
    case llvm::Intrinsic::umax:
      return minimum(operation::less_unsigned, true);
    case llvm::Intrinsic::smin:
      return minimum(operation::less_signed, false);
    case llvm::Intrinsic::smax:
      return minimum(operation::less_signed, true);
    case llvm::Intrinsic::abs: {
      const node_id a = operand(0);
      return nodes_.choose(nodes_.add(operation::less_signed, 1, {a, zero}),
                           nodes_.add(operation::subtract, width, {zero, a}), a);
    }
    case llvm::Intrinsic::usub_sat: {
      const node_id a = operand(0);
      const node_id b = operand(1);
      return nodes_.choose(nodes_.add(operation::less_unsigned, 1, {a, b}), zero,
                           nodes_.add(operation::subtract, width, {a, b}));
    }
    case llvm::Intrinsic::uadd_sat: {
      const node_id a = operand(0);
      const node_id sum = nodes_.add(operation::add, width, {a, operand(1)});
      return nodes_.choose(nodes_.add(operation::less_unsigned, 1, {sum, a}),
                           nodes_.constant(llvm::APInt::getAllOnes(width)), sum);
    }
    case llvm::Intrinsic::fshl:
    case llvm::Intrinsic::fshr:
      return funnel_shift(at, at.getIntrinsicID() == llvm::Intrinsic::fshl);
    case llvm::Intrinsic::bitreverse:
      return nodes_.permuted(operand(0), width, 1);
    case llvm::Intrinsic::bswap:
      return nodes_.permuted(operand(0), width, 8);
    case llvm::Intrinsic::ctpop:
      return nodes_.population_count(operand(0), width);
    case llvm::Intrinsic::ctlz:
      return nodes_.trailing_zeros(nodes_.permuted(operand(0), width, 1), width);
    case llvm::Intrinsic::cttz:
      return nodes_.trailing_zeros(operand(0), width);
    default:
      refuse_instruction(at);
  }
}

node_id step_values::funnel_shift(const llvm::CallInst& at, bool left) {
  const BasicBlock* block = at.getParent();
  const unsigned width = at.getType()->getIntegerBitWidth();
  const node_id high = use(at.getArgOperand(0), block);
  const node_id low = use(at.getArgOperand(1), block);
  const node_id amount = nodes_.add(operation::remainder_unsigned, width,
                                    {use(at.getArgOperand(2), block), nodes_.constant(width, width)});
  const node_id both_words = nodes_.add(operation::concat, 2 * width, {high, low});
  const node_id shifted =
      nodes_.add(left ? operation::shift_left : operation::shift_right_logical, 2 * width, {both_words, amount});
  const node_id result = nodes_.add(operation::slice, width, {shifted});
  nodes_[result].low = left ? width : 0;
  return result;
}

}  // namespace epiline::frontend
