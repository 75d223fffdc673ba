#include "frontend/step_flow.hpp"

#include <llvm/IR/CFG.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>

namespace epiline::frontend {

using llvm::BasicBlock;
using llvm::Instruction;

bool is_impossible(const BasicBlock* block) { return llvm::isa<llvm::UnreachableInst>(block->getTerminator()); }

step_flow::step_flow(const step_structure& steps) : steps_(steps) {
  for (std::size_t i = 0; i < steps_.order.size(); ++i) position_[steps_.order[i]] = static_cast<int>(i);
  find_reachable();
  find_dominators();
  find_postdominators();
}

void step_flow::find_reachable() {
  const std::size_t count = steps_.order.size();
  reaches_.assign(count, std::vector<bool>(count, false));
  for (std::size_t i = count; i-- > 0;) {
    reaches_[i][i] = true;
    for (const BasicBlock* next : llvm::successors(steps_.order[i])) {
      if (steps_.is_cut(next)) continue;
      const auto n = static_cast<std::size_t>(position(next));
      for (std::size_t j = 0; j < count; ++j)
        if (reaches_[n][j]) reaches_[i][j] = true;
    }
  }
}

bool step_flow::reaches(const BasicBlock* from, const BasicBlock* to) const {
  return reaches_[static_cast<std::size_t>(position(from))][static_cast<std::size_t>(position(to))];
}

std::vector<const BasicBlock*> step_flow::predecessors(const BasicBlock* block) const {
  std::vector<const BasicBlock*> result;
  if (steps_.is_cut(block)) return result;
  for (const BasicBlock* before : llvm::predecessors(block))
    if (std::find(result.begin(), result.end(), before) == result.end()) result.push_back(before);
  return result;
}

void step_flow::find_dominators() {
  const int count = static_cast<int>(steps_.order.size());
  dominator_.assign(static_cast<std::size_t>(count), -1);
  for (int i = 0; i < count; ++i) {
    const BasicBlock* block = steps_.order[static_cast<std::size_t>(i)];
    if (steps_.is_cut(block)) continue;
    int common = -2;
    for (const BasicBlock* before : predecessors(block)) {
      int at = position(before);
      if (common == -2) {
        common = at;
        continue;
      }
      while (common != at) {
        if (common > at)
          common = dominator_[static_cast<std::size_t>(common)];
        else
          at = dominator_[static_cast<std::size_t>(at)];
        if (common == -1 || at == -1) {
          common = -1;
          break;
        }
      }
      if (common == -1) break;
    }
    dominator_[static_cast<std::size_t>(i)] = common == -2 ? -1 : common;
  }
}

void step_flow::find_postdominators() {
  const int count = static_cast<int>(steps_.order.size());
  postdominator_.assign(static_cast<std::size_t>(count), count);
  for (int i = count - 1; i >= 0; --i) {
    int common = -2;
    for (const BasicBlock* next : llvm::successors(steps_.order[static_cast<std::size_t>(i)])) {
      if (is_impossible(next)) continue;
      int at = steps_.is_cut(next) ? count : position(next);
      if (common == -2) {
        common = at;
        continue;
      }
      while (common != at) {
        if (common < at)
          common = common == count ? count : postdominator_[static_cast<std::size_t>(common)];
        else
          at = at == count ? count : postdominator_[static_cast<std::size_t>(at)];
        if (common == count || at == count) {
          common = count;
          break;
        }
      }
      if (common == count) break;
    }
    postdominator_[static_cast<std::size_t>(i)] = common == -2 ? count : common;
  }
}

const BasicBlock* step_flow::dominator(const BasicBlock* block) const {
  const int above = dominator_[static_cast<std::size_t>(position(block))];
  return above < 0 ? nullptr : steps_.order[static_cast<std::size_t>(above)];
}

bool step_flow::dominates(const BasicBlock* above, const BasicBlock* below) const {
  const int target = position(above);
  for (int at = position(below); at >= 0; at = dominator_[static_cast<std::size_t>(at)])
    if (at == target) return true;
  return false;
}

const BasicBlock* step_flow::always_with(const BasicBlock* block) const {
  const int self = position(block);
  const int above = dominator_[static_cast<std::size_t>(self)];
  if (above < 0) return nullptr;
  for (int at = above; at < static_cast<int>(steps_.order.size()) && at <= self;
       at = postdominator_[static_cast<std::size_t>(at)])
    if (at == self) return steps_.order[static_cast<std::size_t>(above)];
  return nullptr;
}

bool step_flow::comes_before(const Instruction* a, const Instruction* b) const {
  return a->getParent() == b->getParent() ? a->comesBefore(b) : position(a->getParent()) < position(b->getParent());
}

}  // namespace epiline::frontend
