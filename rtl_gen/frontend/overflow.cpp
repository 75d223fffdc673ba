#include "frontend/overflow.hpp"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>

#include <vector>

namespace epiline::frontend {

namespace {

/// The result in a type that holds it whatever the operands are; what fits is its lowest part.
llvm::Value* exact(llvm::IRBuilder<>& builder, const llvm::BinaryOpIntrinsic& at) {
  const unsigned width = at.getLHS()->getType()->getIntegerBitWidth();
  const bool is_product = at.getBinaryOp() == llvm::Instruction::Mul;
  llvm::Type* const wide = builder.getIntNTy(is_product ? 2 * width : width + 1);
  const auto extend = [&](llvm::Value* operand) {
    return at.isSigned() ? builder.CreateSExt(operand, wide) : builder.CreateZExt(operand, wide);
  };
  return builder.CreateBinOp(at.getBinaryOp(), extend(at.getLHS()), extend(at.getRHS()));
}

/// Whether `result`, which has more bits than `fitting`, is another number.
llvm::Value* differs(llvm::IRBuilder<>& builder, llvm::Value* result, llvm::Value* fitting, bool is_signed) {
  llvm::Type* const wide = result->getType();
  return builder.CreateICmpNE(result,
                              is_signed ? builder.CreateSExt(fitting, wide) : builder.CreateZExt(fitting, wide));
}

void write_out(llvm::WithOverflowInst& at) {
  llvm::IRBuilder<> builder(&at);
  llvm::Value* const result = exact(builder, at);
  llvm::Value* const fitting = builder.CreateTrunc(result, at.getLHS()->getType());
  llvm::Value* const overflow = differs(builder, result, fitting, at.isSigned());
  std::vector<llvm::Instruction*> parts;
  for (llvm::User* user : at.users())
    if (auto* part = llvm::dyn_cast<llvm::ExtractValueInst>(user)) parts.push_back(part);
  for (llvm::Instruction* part : parts) {
    const bool is_result = llvm::cast<llvm::ExtractValueInst>(part)->getIndices().front() == 0;
    part->replaceAllUsesWith(is_result ? fitting : overflow);
    part->eraseFromParent();
  }
  if (at.use_empty()) at.eraseFromParent();
}

void write_out(llvm::SaturatingInst& at) {
  llvm::IRBuilder<> builder(&at);
  llvm::Type* const type = at.getType();
  llvm::Value* const result = exact(builder, at);
  llvm::Value* const fitting = builder.CreateTrunc(result, type);
  const unsigned width = type->getIntegerBitWidth();
  llvm::Value* const is_negative = builder.CreateICmpSLT(result, llvm::ConstantInt::get(result->getType(), 0));
  llvm::Value* const limit =
      builder.CreateSelect(is_negative, llvm::ConstantInt::get(type, llvm::APInt::getSignedMinValue(width)),
                           llvm::ConstantInt::get(type, llvm::APInt::getSignedMaxValue(width)));
  at.replaceAllUsesWith(builder.CreateSelect(differs(builder, result, fitting, true), limit, fitting));
  at.eraseFromParent();
}

}  // namespace

void write_out_overflow(llvm::Function& function) {
  std::vector<llvm::BinaryOpIntrinsic*> found;
  for (llvm::Instruction& instruction : llvm::instructions(function))
    if (auto* arithmetic = llvm::dyn_cast<llvm::BinaryOpIntrinsic>(&instruction)) found.push_back(arithmetic);
  for (llvm::BinaryOpIntrinsic* at : found) {
    if (auto* asked = llvm::dyn_cast<llvm::WithOverflowInst>(at))
      write_out(*asked);
    else if (at->isSigned())  // without a sign: a comparison and a choice, which need no more bits (step_values::call)
      write_out(*llvm::cast<llvm::SaturatingInst>(at));
  }
}

}  // namespace epiline::frontend
