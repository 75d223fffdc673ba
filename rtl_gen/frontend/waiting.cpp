#include "frontend/waiting.hpp"

#include <fmt/format.h>
#include <llvm/ADT/SmallPtrSet.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/ValueHandle.h>
#include <llvm/Transforms/Utils/Cloning.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/loops.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

using llvm::BasicBlock;
using llvm::CallInst;
using llvm::Instruction;

bool asks_empty(const Instruction& instruction) { return calls_named(instruction, "__epiline_stream_empty"); }
bool asks(const Instruction& instruction) {
  return asks_empty(instruction) || calls_named(instruction, "__epiline_stream_full");
}

std::vector<CallInst*> questions_of(llvm::Function& function) {
  std::vector<CallInst*> found;
  for (const char* name : {"__epiline_stream_empty", "__epiline_stream_full"})
    for (CallInst* question : calls_of(*function.getParent(), name, &function)) found.push_back(question);
  return found;
}

bool takes_argument(const Instruction& instruction) { return calls_named(instruction, "__epiline_argument"); }

bool writes_variable(const Instruction& instruction) {
  const auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction);
  const auto* copy = llvm::dyn_cast<llvm::AnyMemIntrinsic>(&instruction);
  const llvm::Value* const written = store != nullptr  ? store->getPointerOperand()
                                     : copy != nullptr ? copy->getRawDest()
                                                       : nullptr;
  return written != nullptr && llvm::isa<llvm::AllocaInst>(llvm::getUnderlyingObject(written));
}

/// No way leads out, but those that are never taken.
bool never_ends(const llvm::Loop& loop) {
  llvm::SmallVector<BasicBlock*> exits;
  loop.getExitBlocks(exits);
  return std::all_of(exits.begin(), exits.end(),
                     [](const BasicBlock* exit) { return llvm::isa<llvm::UnreachableInst>(exit->getTerminator()); });
}

void answer(CallInst& question, bool yes) {
  question.replaceAllUsesWith(llvm::ConstantInt::get(question.getType(), yes ? 1 : 0));
}

bool is_same_stream(const CallInst& a, const CallInst& b) {
  const llvm::DataLayout& layout = a.getModule()->getDataLayout();
  llvm::APInt place_a(64, 0), place_b(64, 0);
  return a.getArgOperand(0)->stripAndAccumulateConstantOffsets(layout, place_a, true) ==
             b.getArgOperand(0)->stripAndAccumulateConstantOffsets(layout, place_b, true) &&
         place_a == place_b;
}

[[noreturn]] void refuse_question(const CallInst& question, const std::string& where) {
  refuse(place_of(question),
         fmt::format("empty(), full() and non-blocking access of a stream make results depend on timing {}: read() and "
                     "write() wait by themselves, so leave 'if (!in.empty())' away, and end a loop by a count or by a "
                     "mark in the tokens",
                     where));
}

/// A copy of the process in which some questions have their answers. The calls stay, as marks.
class answered_process {
 public:
  /// `yes`: the one of the questions whose answer is yes; null: all answers are no.
  answered_process(const std::vector<CallInst*>& questions, const CallInst* yes, analysis_managers& managers)
      : managers_(managers) {
    llvm::ValueToValueMapTy copies;
    copy_ = llvm::CloneFunction(questions.front()->getFunction(), copies);
    for (const CallInst* question : questions) {
      auto* const copy = llvm::cast<CallInst>(copies[question]);
      if (question == yes) answer(*copy, true);
      if (yes == nullptr) answer(*copy, false);
      copies_.emplace(question, copy);
    }
    run_passes(*copy_, managers_, early_cleanup());
    dominators_.recalculate(*copy_);
    loops_.analyze(dominators_);
  }
  answered_process(const answered_process&) = delete;
  answered_process& operator=(const answered_process&) = delete;
  ~answered_process() {
    managers_.function.clear(*copy_, copy_->getName());
    copy_->eraseFromParent();
  }

  /// Whether a way leads to the question.
  [[nodiscard]] bool is_asked(const CallInst* question) const { return mark_of(question) != nullptr; }

  /// What a call in which this question is asked does; null: nothing.
  [[nodiscard]] const Instruction* effect_around(const CallInst* question) const {
    const CallInst* const mark = mark_of(question);
    if (mark == nullptr) return nullptr;
    for (const bool after : {false, true})
      for (const BasicBlock* block : blocks_from(mark->getParent(), after))
        for (const Instruction& instruction : *block) {
          const bool is_on_the_way = block != mark->getParent() || mark->comesBefore(&instruction) == after;
          if (is_on_the_way && has_effect(instruction)) return &instruction;
        }
    return nullptr;
  }

  /// Whether the question stands in a loop of the source that never ends.
  [[nodiscard]] bool is_in_a_loop(const CallInst* question) const {
    const CallInst* const mark = mark_of(question);
    const llvm::Loop* const loop = mark == nullptr ? nullptr : loops_.getLoopFor(mark->getParent());
    return loop != nullptr && !is_of_calls(*loop);
  }

  /// Whether a variable of the source's endless loop around the question has another value in the next pass.
  [[nodiscard]] bool changes_a_variable(const CallInst* question) const {
    if (!is_in_a_loop(question)) return false;
    const BasicBlock* const start = mark_of(question)->getParent();
    llvm::SmallPtrSet<const BasicBlock*, 16> on_the_way, after;
    for (const BasicBlock* block : blocks_from(start, false)) on_the_way.insert(block);
    for (const BasicBlock* block : blocks_from(start, true)) {
      on_the_way.insert(block);
      after.insert(block);
    }
    for (const llvm::PHINode& variable : loops_.getLoopFor(start)->getHeader()->phis())
      for (const BasicBlock* last : variable.blocks())
        if (after.contains(last) && !is_kept(variable, variable.getIncomingValueForBlock(last), on_the_way))
          return true;
    return false;
  }

  /// With all answers no: whether what the process does from one question to the next is the same whether or not they
  /// are in one call. `stays`: the answer yes leaves no loop.
  [[nodiscard]] bool keeps_nothing(const CallInst* question, bool stays) const {
    const CallInst* const mark = mark_of(question);
    if (mark == nullptr) return true;
    if (!ends_with_the_pass(*mark, stays)) return false;
    if (stays || !is_in_a_loop(question)) return true;
    // `while (!in.empty())`: natively a new call, with other arguments and new variables; in hardware the same one.
    return std::none_of(llvm::inst_begin(*copy_), llvm::inst_end(*copy_), takes_argument) &&
           !any_in(*loops_.getLoopFor(mark->getParent()), writes_variable);
  }

  /// With all answers no: whether the stream of a question is read on every way from there.
  [[nodiscard]] bool reads_after(const CallInst* question) const {
    const CallInst* const mark = mark_of(question);
    if (mark == nullptr) return true;
    const auto reads = [&](const Instruction& instruction) {
      return calls_named(instruction, "__epiline_stream_read") &&
             is_same_stream(*mark, llvm::cast<CallInst>(instruction));
    };
    const BasicBlock* const first = mark->getParent();
    if (std::any_of(mark->getIterator(), first->end(), reads)) return true;
    llvm::SmallPtrSet<const BasicBlock*, 16> seen;
    std::vector<const BasicBlock*> pending{first};
    while (!pending.empty()) {
      const BasicBlock* const block = pending.back();
      pending.pop_back();
      if (block != first && std::any_of(block->begin(), block->end(), reads)) continue;
      if (is_end(*block)) return false;
      for (const BasicBlock* next : llvm::successors(block))
        if (seen.insert(next).second) pending.push_back(next);
    }
    return true;
  }

 private:
  /// The question in the copy; null: no way leads there.
  [[nodiscard]] const CallInst* mark_of(const CallInst* question) const {
    return llvm::cast_or_null<CallInst>(static_cast<llvm::Value*>(copies_.at(question)));
  }

  /// The next call begins at the head of the loop that never ends.
  [[nodiscard]] bool begins_a_call(const BasicBlock& block) const {
    const llvm::Loop* const loop = loops_.getLoopFor(&block);
    return loop != nullptr && loop->getHeader() == &block && never_ends(*loop);
  }
  [[nodiscard]] bool is_end(const BasicBlock& block) const {
    return llvm::isa<llvm::ReturnInst>(block.getTerminator()) ||
           std::any_of(llvm::succ_begin(&block), llvm::succ_end(&block),
                       [&](const BasicBlock* next) { return begins_a_call(*next); });
  }

  /// The loop of the process around its calls, in contrast to one of the source.
  [[nodiscard]] static bool is_of_calls(const llvm::Loop& loop) {
    return any_in(loop, [](const Instruction& instruction) {
      return calls_named(instruction, "__epiline_port") || takes_argument(instruction);
    });
  }

  /// Not in a loop of the source that counts or ends, nor in one that the answer yes leaves and that keeps something
  /// from one pass to the next. From call to call nothing is kept but state: a variable that is not written on every
  /// way has no value then.
  [[nodiscard]] bool ends_with_the_pass(const CallInst& mark, bool stays) const {
    const llvm::Loop* const loop = loops_.getLoopFor(mark.getParent());
    return loop == nullptr || (never_ends(*loop) && (stays || is_of_calls(*loop) || loop->getHeader()->phis().empty()));
  }

  /// Whether `value`, with which a pass ends that led over these blocks, is what the variable was when it began.
  [[nodiscard]] static bool is_kept(const llvm::PHINode& variable, const llvm::Value* value,
                                    const llvm::SmallPtrSetImpl<const BasicBlock*>& on_the_way) {
    llvm::SmallPtrSet<const llvm::Value*, 16> seen{&variable};
    std::vector<const llvm::Value*> pending{value};
    while (!pending.empty()) {
      const llvm::Value* const one = pending.back();
      pending.pop_back();
      if (!seen.insert(one).second) continue;
      const auto* const joined = llvm::dyn_cast<llvm::PHINode>(one);
      if (joined == nullptr || !on_the_way.contains(joined->getParent())) return false;
      for (const BasicBlock* from : joined->blocks())
        if (on_the_way.contains(from)) pending.push_back(joined->getIncomingValueForBlock(from));
    }
    return true;
  }

  /// The blocks of the same call that can come before, or after, with `start`.
  [[nodiscard]] std::vector<const BasicBlock*> blocks_from(const BasicBlock* start, bool after) const {
    llvm::SmallPtrSet<const BasicBlock*, 16> seen{start};
    std::vector<const BasicBlock*> found{start};
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto add = [&](const BasicBlock* block) {
        if (seen.insert(block).second) found.push_back(block);
      };
      if (after)
        for (const BasicBlock* next : llvm::successors(found[i])) {
          if (!begins_a_call(*next)) add(next);
        }
      else if (!begins_a_call(*found[i]))
        for (const BasicBlock* before : llvm::predecessors(found[i])) add(before);
    }
    return found;
  }

  /// Variables of one call are gone when it ends. In an endless loop of the source they are not.
  [[nodiscard]] bool dies_with_the_call(const Instruction& at) const {
    if (!writes_variable(at)) return false;
    const llvm::Loop* const loop = loops_.getLoopFor(at.getParent());
    return loop == nullptr || is_of_calls(*loop);
  }

  [[nodiscard]] bool has_effect(const Instruction& instruction) const {
    if (llvm::isa<llvm::StoreInst, llvm::AnyMemIntrinsic>(instruction)) return !dies_with_the_call(instruction);
    if (!llvm::isa<llvm::CallBase>(instruction) || llvm::isa<llvm::IntrinsicInst>(instruction)) return false;
    if (asks(instruction)) return false;
    return std::none_of(std::begin(harmless), std::end(harmless),
                        [&](const char* name) { return calls_named(instruction, name); });
  }
  static constexpr const char* harmless[] = {"__epiline_port", "__epiline_argument", "__epiline_unwritten",
                                             "__epiline_internal_stream", "__epiline_pragma_"};

  analysis_managers& managers_;
  llvm::Function* copy_ = nullptr;
  std::map<const CallInst*, llvm::WeakVH> copies_;
  llvm::DominatorTree dominators_;
  llvm::LoopInfo loops_;
};

}  // namespace

void wait_instead_of_asking(llvm::Function& process, analysis_managers& managers, bool is_part) {
  const std::vector<CallInst*> questions = questions_of(process);
  if (questions.empty()) return;
  const bool takes_scalars = is_part && std::any_of(llvm::inst_begin(process), llvm::inst_end(process), takes_argument);
  std::set<const CallInst*> in_loops;
  for (const CallInst* question : questions) {
    const answered_process with_yes(questions, question, managers);
    if (takes_scalars && with_yes.is_asked(question)) refuse_question(*question, "in a process that takes scalars");
    if (const Instruction* const effect = with_yes.effect_around(question))
      refuse_question(*question, fmt::format("since line {} does something even when the stream {}",
                                             place_of(*effect).line, asks_empty(*question) ? "is empty" : "is full"));
    if (with_yes.changes_a_variable(question))
      refuse_question(*question, fmt::format("since a variable of the loop changes even when the stream {}",
                                             asks_empty(*question) ? "is empty" : "is full"));
    if (with_yes.is_in_a_loop(question)) in_loops.insert(question);
  }
  {
    const answered_process all_no(questions, nullptr, managers);
    for (const CallInst* question : questions) {
      if (!all_no.keeps_nothing(question, in_loops.contains(question)))
        refuse_question(*question, "in a loop that ends, counts or keeps something");
      if (asks_empty(*question) && !all_no.reads_after(question))
        refuse_question(*question, "where the stream is not read on every way from here");
    }
  }
  for (CallInst* question : questions) {
    answer(*question, false);
    question->eraseFromParent();
  }
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
}

}  // namespace epiline::frontend
