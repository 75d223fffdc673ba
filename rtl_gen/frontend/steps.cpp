#include "frontend/steps.hpp"

#include <llvm/ADT/SCCIterator.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Local.h>

#include <algorithm>
#include <functional>
#include <set>

#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

class cutter {
 public:
  explicit cutter(lowered_process& process) : process_(process), function_(*process.function) {}

  step_structure run() {
    llvm::removeUnreachableBlocks(function_);
    cut(function_.getEntryBlock());
    cut_loops();
    cut_calls();
    cut_remaining_cycles();
    cut_reads_outside_loops();
    cut_repeated_accesses();
    return finish();
  }

 private:
  void cut(llvm::BasicBlock& block) {
    if (is_cut_.insert(&block).second) cuts_.push_back(&block);
  }

  /// Innermost loops first: their headers are where clocks go. Remembers each block's innermost loop.
  void cut_loops() {
    llvm::DominatorTree dominators(function_);
    llvm::LoopInfo loops(dominators);
    for (llvm::BasicBlock& block : function_)
      if (const llvm::Loop* loop = loops.getLoopFor(&block)) {
        for (const llvm::Loop* outer = loop; outer != nullptr; outer = outer->getParentLoop())
          loops_of_[&block].insert(outer->getHeader());
        innermost_[&block] = loop->getHeader();
      }
    for (llvm::Loop* loop : loops.getLoopsInPreorder())
      if (loop->isInnermost()) {
        cut(*loop->getHeader());
        inner_headers_.insert(loop->getHeader());
      }
  }

  /// The call's scalars are taken in a step of their own, so that a frame's last results never wait for the next call,
  /// and the arithmetic on them has time.
  void cut_calls() {
    for (llvm::BasicBlock& block : function_) {
      for (llvm::Instruction& instruction : block) {
        if (access_of(instruction) != access::read ||
            process_.ports[object_of(instruction)].kind != dataflow::port_kind::call)
          continue;
        // At the block's start when nothing is accessed before: its phis then are registers with reset values.
        llvm::BasicBlock* start = &block;
        for (const llvm::Instruction* before = block.getFirstNonPHI(); before != &instruction && start == &block;
             before = before->getNextNode())
          if (access_of(*before) != access::none) start = split(instruction);
        // Without a loop in the call there is nothing to wait for: every clock may be a call.
        const auto loop = innermost_.find(start);
        const bool has_loops = loop == innermost_.end() || is_cut_.count(loop->second) == 0;
        cut(*start);
        if (!has_loops) return;
        patient_ = start;
        llvm::Instruction* end = instruction.getNextNode();
        while (!end->isTerminator() && access_of(*end) == access::none) end = end->getNextNode();
        cut(*split(*end));
        return;
      }
    }
  }

  llvm::BasicBlock* split(llvm::Instruction& before) {
    llvm::BasicBlock* const block = before.getParent();
    llvm::BasicBlock* const rest = llvm::SplitBlock(block, &before);
    copy_loops(block, rest);
    return rest;
  }

  void copy_loops(const llvm::BasicBlock* from, llvm::BasicBlock* to) {
    loops_of_[to] = loops_of_[from];
    innermost_[to] = innermost_[from];
  }

  /// Cycles that avoid every cut so far: passes of an outer loop in which an inner loop does nothing. Cutting the edge
  /// around the inner loop costs clocks only there.
  void cut_remaining_cycles() {
    for (;;) {
      const std::vector<llvm::BasicBlock*> cycle = uncut_cycle();
      if (cycle.empty()) return;
      const std::set<llvm::BasicBlock*> inside(cycle.begin(), cycle.end());
      llvm::BasicBlock* from = nullptr;
      llvm::BasicBlock* to = nullptr;
      for (llvm::BasicBlock* block : cycle) {
        bool enters_loop = false;
        llvm::BasicBlock* around = nullptr;
        for (llvm::BasicBlock* next : llvm::successors(block)) {
          if (inside.count(next) != 0)
            around = next;
          else if (leads_into_loop(next))
            enters_loop = true;
        }
        if (enters_loop && around != nullptr) {
          from = block;
          to = around;
        }
      }
      if (from != nullptr) {
        llvm::BasicBlock* const between = llvm::SplitEdge(from, to);
        copy_loops(to, between);
        cut(*between);
      } else {
        cut(*header_in(cycle));
      }
    }
  }

  bool leads_into_loop(llvm::BasicBlock* block) const {
    for (unsigned hops = 0; block != nullptr && hops < 8; ++hops) {
      if (is_cut_.count(block) != 0) return inner_headers_.count(block) != 0;
      block = block->getSingleSuccessor();
    }
    return false;
  }

  llvm::BasicBlock* header_in(const std::vector<llvm::BasicBlock*>& cycle) const {
    for (llvm::BasicBlock* block : cycle)
      if (const auto found = innermost_.find(block); found != innermost_.end() && found->second == block) return block;
    return cycle.front();
  }

  /// The blocks of one strongly connected part of the control flow without its cuts, in function order; empty: none.
  std::vector<llvm::BasicBlock*> uncut_cycle() {
    std::map<const llvm::BasicBlock*, std::set<const llvm::BasicBlock*>> reach;
    for (llvm::BasicBlock& start : function_) {
      if (is_cut_.count(&start) != 0) continue;
      std::vector<llvm::BasicBlock*> pending{&start};
      auto& seen = reach[&start];
      while (!pending.empty()) {
        llvm::BasicBlock* const block = pending.back();
        pending.pop_back();
        for (llvm::BasicBlock* next : llvm::successors(block))
          if (is_cut_.count(next) == 0 && seen.insert(next).second) pending.push_back(next);
      }
    }
    for (llvm::BasicBlock& start : function_) {
      if (is_cut_.count(&start) != 0 || reach[&start].count(&start) == 0) continue;
      std::vector<llvm::BasicBlock*> cycle;
      for (llvm::BasicBlock& block : function_)
        if (reach[&start].count(&block) != 0 && reach[&block].count(&start) != 0) cycle.push_back(&block);
      return cycle;
    }
    return {};
  }

  /// A step that leaves a loop must not wait for a token read after it: what the loop's last pass writes would wait
  /// too.
  void cut_reads_outside_loops() {
    std::vector<llvm::BasicBlock*> pending(cuts_.begin(), cuts_.end());
    for (std::size_t i = 0; i < pending.size(); ++i) {
      llvm::BasicBlock* const start = pending[i];
      const auto home = innermost_.find(start);
      if (home == innermost_.end()) continue;
      for (llvm::BasicBlock* block : blocks_of_step(start)) {
        if (block == start || is_cut_.count(block) != 0) continue;
        const auto loops = loops_of_.find(block);
        if (loops != loops_of_.end() && loops->second.count(home->second) != 0) continue;
        if (std::none_of(block->begin(), block->end(),
                         [](const llvm::Instruction& at) { return access_of(at) == access::read; }))
          continue;
        cut(*block);
        pending.push_back(block);
      }
    }
  }

  /// The blocks a step that starts at `start` may run through, predecessors first.
  std::vector<llvm::BasicBlock*> blocks_of_step(llvm::BasicBlock* start) const {
    std::vector<llvm::BasicBlock*> postorder;
    std::set<llvm::BasicBlock*> seen{start};
    const std::function<void(llvm::BasicBlock*)> visit = [&](llvm::BasicBlock* block) {
      for (llvm::BasicBlock* next : llvm::successors(block))
        if (is_cut_.count(next) == 0 && seen.insert(next).second) visit(next);
      postorder.push_back(block);
    };
    visit(start);
    std::reverse(postorder.begin(), postorder.end());
    return postorder;
  }

  /// What may be used once a step: a port, or a memory's write port.
  static std::pair<int, unsigned> resource_of(const llvm::Instruction& instruction) {
    const access kind = access_of(instruction);
    if (kind == access::read || kind == access::write) return {0, object_of(instruction)};
    if (kind == access::memory_write) return {1, object_of(instruction)};
    return {-1, 0};
  }

  void cut_repeated_accesses() {
    while (cut_one_repeated_access()) {
    }
  }

  bool cut_one_repeated_access() {
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      std::map<const llvm::BasicBlock*, std::set<std::pair<int, unsigned>>> used;  // before each block
      for (llvm::BasicBlock* block : blocks_of_step(cuts_[i])) {
        auto here = used[block];
        for (llvm::Instruction& instruction : *block) {
          const auto resource = resource_of(instruction);
          if (resource.first < 0 || here.insert(resource).second) continue;
          cut(*(&instruction == block->getFirstNonPHI() ? block : split(instruction)));
          return true;
        }
        for (llvm::BasicBlock* next : llvm::successors(block))
          if (is_cut_.count(next) == 0) used[next].insert(here.begin(), here.end());
      }
    }
    return false;
  }

  step_structure finish() {
    step_structure result;
    result.cuts = cuts_;
    for (unsigned i = 0; i < cuts_.size(); ++i) {
      result.cut_number[cuts_[i]] = i;
      if (cuts_[i] == patient_) result.patient_cut = static_cast<int>(i);
    }
    std::set<llvm::BasicBlock*> seen;
    std::vector<llvm::BasicBlock*> postorder;
    const std::function<void(llvm::BasicBlock*)> visit = [&](llvm::BasicBlock* block) {
      if (!seen.insert(block).second) return;
      for (llvm::BasicBlock* next : llvm::successors(block))
        if (is_cut_.count(next) == 0) visit(next);
      postorder.push_back(block);
    };
    for (auto start = cuts_.rbegin(); start != cuts_.rend(); ++start) visit(*start);
    result.order.assign(postorder.rbegin(), postorder.rend());
    return result;
  }

  lowered_process& process_;
  llvm::Function& function_;
  std::vector<llvm::BasicBlock*> cuts_;
  std::set<const llvm::BasicBlock*> is_cut_;
  std::map<const llvm::BasicBlock*, std::set<const llvm::BasicBlock*>> loops_of_;  // headers of all loops around it
  std::map<const llvm::BasicBlock*, const llvm::BasicBlock*> innermost_;           // header of the innermost one
  std::set<const llvm::BasicBlock*> inner_headers_;                                // of loops without loops in them
  llvm::BasicBlock* patient_ = nullptr;
};

}  // namespace

step_structure cut_into_steps(lowered_process& process) { return cutter(process).run(); }

}  // namespace epiline::frontend
