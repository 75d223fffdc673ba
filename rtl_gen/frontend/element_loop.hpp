#pragma once

#include <llvm/IR/IRBuilder.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

#include <cstdint>

namespace epiline::frontend {

/// Makes a loop where the builder stands, inside of a block: `body(index)` is called once and builds what happens for
/// every index from 0 to count - 1 (at least one), at the builder's place, which may come to stand in another block.
/// Afterwards the builder stands behind the loop.
template <class Body>
void for_each_index(llvm::IRBuilder<>& builder, std::uint64_t count, const Body& body) {
  llvm::BasicBlock* const before = builder.GetInsertBlock();
  llvm::BasicBlock* const after = llvm::SplitBlock(before, builder.GetInsertPoint());
  llvm::BasicBlock* const loop = llvm::BasicBlock::Create(before->getContext(), "each", before->getParent(), after);
  before->getTerminator()->setSuccessor(0, loop);
  builder.SetInsertPoint(loop);
  llvm::PHINode* const index = builder.CreatePHI(builder.getInt64Ty(), 2, "each_index");
  builder.SetInsertPoint(builder.CreateBr(after));
  body(static_cast<llvm::Value*>(index));
  llvm::Instruction* const end = builder.GetInsertBlock()->getTerminator();
  llvm::Value* const next = builder.CreateNUWAdd(index, builder.getInt64(1));
  builder.CreateCondBr(builder.CreateICmpEQ(next, builder.getInt64(count)), after, loop);
  end->eraseFromParent();
  index->addIncoming(builder.getInt64(0), before);
  index->addIncoming(next, builder.GetInsertBlock());
  builder.SetInsertPoint(after, after->begin());
}

}  // namespace epiline::frontend
