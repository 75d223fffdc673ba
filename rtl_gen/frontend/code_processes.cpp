#include "frontend/code_processes.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/CodeExtractor.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "frontend/calls.hpp"
#include "frontend/loops.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

class outliner {
 public:
  outliner(llvm::Function& top, const std::vector<llvm::Function*>& processes) : top_(top), processes_(processes) {}

  std::vector<llvm::Function*> run() {
    while (std::optional<piece> next = find_piece()) outline(*next);
    return std::move(made_);
  }

 private:
  /// Blocks that become a function, and the first access among them.
  struct piece {
    std::vector<llvm::BasicBlock*> blocks;
    const llvm::Instruction* access;
    bool is_loop;
  };

  static bool is_access(const llvm::Instruction& instruction) { return calls_named(instruction, "__epiline_stream_"); }

  [[nodiscard]] bool is_process(const llvm::Instruction& instruction) const {
    const auto is_among = [&](const std::vector<llvm::Function*>& list) {
      return std::find(list.begin(), list.end(), called_by(instruction)) != list.end();
    };
    return called_by(instruction) != nullptr && (is_among(processes_) || is_among(made_));
  }

  /// Whether a stream is written and read in a loop.
  [[nodiscard]] bool joins(const llvm::Loop& loop) const {
    std::set<const llvm::Value*> written, read;
    const llvm::DataLayout& layout = top_.getParent()->getDataLayout();
    for (const llvm::BasicBlock* block : loop.blocks())
      for (const llvm::Instruction& instruction : *block) {
        if (!is_access(instruction)) continue;
        llvm::APInt offset(64, 0);
        const llvm::Value* const stream =
            instruction.getOperand(0)->stripAndAccumulateConstantOffsets(layout, offset, true);
        (calls_named(instruction, "__epiline_stream_write") ? written : read).insert(stream);
      }
    return std::any_of(written.begin(), written.end(), [&](const auto* stream) { return read.count(stream) != 0; });
  }

  std::optional<piece> find_piece() const {
    const llvm::DominatorTree dominators(top_);
    const llvm::LoopInfo loops(dominators);
    for (const llvm::Loop* loop : loops)
      if (std::optional<piece> found = find_in(*loop)) return found;
    return find_statements(dominators, loops);
  }

  [[nodiscard]] bool has_process(const llvm::Loop& loop) const {
    return any_in(loop, [&](const llvm::Instruction& instruction) { return is_process(instruction); });
  }

  /// The loop without an end is the hardware's: call after call.
  [[nodiscard]] static bool has_end(const llvm::Loop& loop) { return !loop.hasNoExitBlocks(); }

  [[nodiscard]] std::optional<piece> find_in(const llvm::Loop& loop) const {
    const llvm::Instruction* access = nullptr;
    for (const llvm::BasicBlock* block : loop.blocks())
      for (const llvm::Instruction& instruction : *block)
        if (access == nullptr && is_access(instruction)) access = &instruction;
    if (access == nullptr) return {};
    if (has_end(loop) && !has_process(loop) && !joins(loop)) {
      llvm::SmallVector<llvm::BasicBlock*, 4> exits;
      loop.getUniqueExitBlocks(exits);
      if (exits.size() != 1) return {};
      return piece{{loop.block_begin(), loop.block_end()}, access, true};
    }
    for (const llvm::Loop* inner : loop)
      if (std::optional<piece> found = find_in(*inner)) return found;
    return {};
  }

  /// What may not be taken into a process: calls of others, and what tells of the top's parameters.
  [[nodiscard]] bool is_border(const llvm::Instruction& instruction) const {
    return instruction.isTerminator() || is_process(instruction) ||
           (calls_named(instruction, "__epiline_") && !is_access(instruction) &&
            !calls_named(instruction, "__epiline_pragma_"));
  }

  [[nodiscard]] llvm::BasicBlock::iterator next_border(llvm::BasicBlock::iterator from) const {
    while (!is_border(*from)) ++from;
    return from;
  }

  /// Statements from one place to another, with one way in and one way out.
  struct stretch {
    llvm::BasicBlock* first_block;
    llvm::BasicBlock::iterator begin;  // in it
    std::vector<llvm::BasicBlock*> between;
    llvm::BasicBlock* last_block;    // perhaps the first one
    llvm::BasicBlock::iterator end;  // in it: what is not taken any more
  };

  /// The statements around the first access outside of all loops that are processes, and as many accesses behind it as
  /// have no process in between: from the process before them to the one behind, since what they keep from call to call
  /// is in variables that nobody else may use.
  std::optional<piece> find_statements(const llvm::DominatorTree& dominators, const llvm::LoopInfo& loops) const {
    const std::vector<llvm::BasicBlock*> order = in_order(top_);
    const llvm::Instruction* access = nullptr;
    llvm::BasicBlock* first = nullptr;
    std::optional<stretch> best;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto found = std::find_if(order[i]->begin(), order[i]->end(), is_access);
      if (found == order[i]->end()) continue;
      if (access == nullptr) access = &*found;
      // A loop with several ways out is taken as a whole.
      const llvm::Loop* loop = loops.getLoopFor(order[i]);
      while (loop != nullptr && loop->getParentLoop() != nullptr && !has_process(*loop->getParentLoop()) &&
             has_end(*loop->getParentLoop()))
        loop = loop->getParentLoop();
      llvm::BasicBlock* from = order[i];
      if (loop != nullptr && has_end(*loop) && !has_process(*loop)) {
        from = loop->getLoopPredecessor();
        while (i + 1 < order.size() && loop->contains(order[i + 1])) ++i;
      }
      first = from == nullptr || first == nullptr ? from : dominators.findNearestCommonDominator(first, from);
      std::optional<stretch> wider = first == nullptr ? std::nullopt : find_stretch(*first, order, i, dominators);
      if (!wider) break;
      best = std::move(wider);
    }
    if (access == nullptr) return {};
    if (!best) refuse_access(*access);
    return cut(*best, *access);
  }

  /// From a block to behind the one at `last` in the order, or to where the ways that lead there meet.
  std::optional<stretch> find_stretch(llvm::BasicBlock& first, const std::vector<llvm::BasicBlock*>& order,
                                      std::size_t last, const llvm::DominatorTree& dominators) const {
    stretch found{&first, first.getFirstNonPHIOrDbg()->getIterator(), {}, nullptr, {}};
    for (auto at = found.begin; !at->isTerminator() && !is_access(*at);) {
      const bool border = is_border(*at);
      ++at;
      if (border) found.begin = at;
    }
    found.end = next_border(found.begin);
    if (order[last] == &first) {
      found.last_block = &first;
      return found;
    }
    if (!found.end->isTerminator()) return {};  // a process stands behind the first access
    for (; last < order.size(); ++last)
      if (is_closed(found, *order[last], dominators)) return found;
    return {};
  }

  /// Whether every way from the first block leads to `end`, and nothing else does; fills in what is between.
  bool is_closed(stretch& of, llvm::BasicBlock& end, const llvm::DominatorTree& dominators) const {
    std::set<llvm::BasicBlock*> inside;
    std::vector<llvm::BasicBlock*> pending(llvm::succ_begin(of.first_block), llvm::succ_end(of.first_block));
    while (!pending.empty()) {
      llvm::BasicBlock* const block = pending.back();
      pending.pop_back();
      if (block == &end || !inside.insert(block).second) continue;
      if (block == of.first_block || !dominators.dominates(of.first_block, block) ||
          !next_border(block->begin())->isTerminator())
        return false;
      pending.insert(pending.end(), llvm::succ_begin(block), llvm::succ_end(block));
    }
    for (llvm::BasicBlock* before : llvm::predecessors(&end))
      if (before != of.first_block && inside.count(before) == 0) return false;
    of.between.assign(inside.begin(), inside.end());
    of.last_block = &end;
    of.end = next_border(end.getFirstNonPHIOrDbg()->getIterator());
    return true;
  }

  [[nodiscard]] static piece cut(const stretch& of, const llvm::Instruction& access) {
    piece result{{}, &access, false};
    if (of.end != of.last_block->begin()) of.last_block->splitBasicBlock(of.end);
    result.blocks.push_back(of.begin == of.first_block->begin() ? of.first_block
                                                                : of.first_block->splitBasicBlock(of.begin));
    result.blocks.insert(result.blocks.end(), of.between.begin(), of.between.end());
    if (of.last_block != of.first_block) result.blocks.push_back(of.last_block);
    return result;
  }

  [[noreturn]] static void refuse_access(const llvm::Instruction& access) {
    refuse(place_of(access),
           "DATAFLOW: this access of a stream beside the calls cannot be made a process: put it into a function that "
           "takes the stream");
  }

  void outline(const piece& of) {
    const std::string name = fmt::format("{}_{}", of.is_loop ? "loop" : "line", place_of(*of.access).line);
    llvm::CodeExtractorAnalysisCache cache(top_);
    llvm::CodeExtractor extractor(of.blocks);
    llvm::Function* const function = extractor.isEligible() ? extractor.extractCodeRegion(cache) : nullptr;
    if (function == nullptr) refuse_access(*of.access);
    function->setName(name);
    if (llvm::DISubprogram* const program = function->getSubprogram())
      program->replaceOperandWith(2, llvm::MDString::get(function->getContext(), name));  // its name
    made_.push_back(function);
  }

  llvm::Function& top_;
  const std::vector<llvm::Function*>& processes_;
  std::vector<llvm::Function*> made_;
};

}  // namespace

std::vector<llvm::BasicBlock*> in_order(llvm::Function& function) {
  const llvm::DominatorTree dominators(function);
  const llvm::LoopInfo loops(dominators);
  std::vector<llvm::BasicBlock*> order;
  std::set<const llvm::BasicBlock*> seen{&function.getEntryBlock()};
  struct open_block {
    llvm::BasicBlock* block;
    std::vector<llvm::BasicBlock*> after;  // the last one is next
  };
  const auto open = [&](llvm::BasicBlock* block) {
    std::vector<llvm::BasicBlock*> after(llvm::succ_begin(block), llvm::succ_end(block));
    // What is finished first comes last: ways out of a loop.
    std::ranges::sort(after, std::ranges::greater(), [&](auto* next) { return loops.getLoopDepth(next); });
    return open_block{block, std::move(after)};
  };
  std::vector<open_block> path{open(&function.getEntryBlock())};
  while (!path.empty()) {
    if (path.back().after.empty()) {
      order.push_back(path.back().block);
      path.pop_back();
      continue;
    }
    llvm::BasicBlock* const next = path.back().after.back();
    path.back().after.pop_back();
    if (seen.insert(next).second) path.push_back(open(next));
  }
  std::ranges::reverse(order);
  return order;
}

std::vector<llvm::Function*> outline_accesses(llvm::Function& top, const std::vector<llvm::Function*>& processes) {
  return outliner(top, processes).run();
}

}  // namespace epiline::frontend
