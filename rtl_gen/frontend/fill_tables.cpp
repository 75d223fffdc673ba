#include "frontend/fill_tables.hpp"

#include <fmt/format.h>
#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/Transforms/Scalar/InstSimplifyPass.h>
#include <llvm/Transforms/Scalar/SCCP.h>
#include <llvm/Transforms/Utils/Local.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/compile_time.hpp"
#include "frontend/host_mathematics.hpp"
#include "frontend/loops.hpp"
#include "frontend/power_up.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

using blocks = std::set<const llvm::BasicBlock*>;

/// Of a loop without floating point, which may also never end: a number of many digits, but no table.
constexpr std::uint64_t most_steps_of_a_number = 300'000;

bool is_mathematics(const llvm::Instruction& at) {
  const llvm::Function* const callee = called_by(at);
  return callee != nullptr && callee->isDeclaration() && is_host_mathematics(callee->getName());
}

/// Whether nothing could be made of an instruction but its result.
bool is_floating(const llvm::Instruction& at) {
  return at.getType()->isFloatingPointTy() || is_mathematics(at) ||
         std::any_of(at.op_begin(), at.op_end(),
                     [](const llvm::Use& operand) { return operand->getType()->isFloatingPointTy(); });
}

/// What is done with a variable.
struct uses_of_variable {
  std::vector<const llvm::Instruction*> reads;
  std::vector<const llvm::Instruction*> writes;
  bool is_clear = true;  // nothing else happens with it that matters
};

void find_uses(const llvm::Value& address, uses_of_variable& result) {
  for (const llvm::Use& use : address.uses()) {
    const llvm::User* const user = use.getUser();
    if (llvm::isa<llvm::GEPOperator>(user)) {
      find_uses(*user, result);
      continue;
    }
    const auto* at = llvm::dyn_cast<llvm::Instruction>(user);
    if (at == nullptr) {
      result.is_clear = false;
    } else if (llvm::isa<llvm::LoadInst>(at)) {
      result.reads.push_back(at);
    } else if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(at);
               store != nullptr && store->getPointerOperand() == use.get() && store->getValueOperand() != use.get()) {
      result.writes.push_back(at);
    } else if (llvm::isa<llvm::MemTransferInst>(at)) {
      (use.getOperandNo() == 0 ? result.writes : result.reads).push_back(at);
    } else if (llvm::isa<llvm::MemSetInst>(at)) {
      result.writes.push_back(at);
    } else {
      const llvm::Function* const called = called_by(*at);
      const llvm::StringRef callee = called == nullptr ? "" : called->getName();
      if (callee == "__epiline_stream_write" || callee == "__epiline_result")
        result.reads.push_back(at);
      else if (!calls_named(*at, "__epiline_pragma_") && !at->isLifetimeStartOrEnd() &&
               !llvm::isa<llvm::DbgInfoIntrinsic>(at) &&
               (called == nullptr || called->getIntrinsicID() != llvm::Intrinsic::invariant_start))
        result.is_clear = false;
    }
  }
}

uses_of_variable uses_of(const llvm::Value& variable) {
  uses_of_variable result;
  find_uses(variable, result);
  return result;
}

bool are_all_in(const std::vector<const llvm::Instruction*>& places, const blocks& part) {
  return std::all_of(places.begin(), places.end(),
                     [&](const llvm::Instruction* at) { return part.count(at->getParent()) != 0; });
}

/// What `of` is when `from` is `known`; null: something else decides it, too.
llvm::Constant* value_if(llvm::Value* of, const llvm::Value& from, const llvm::Constant* known) {
  if (of == &from) return const_cast<llvm::Constant*>(known);
  if (auto* constant = llvm::dyn_cast<llvm::Constant>(of)) return constant;
  const auto* at = llvm::dyn_cast<llvm::Instruction>(of);
  if (at == nullptr || !(llvm::isa<llvm::CmpInst, llvm::CastInst, llvm::BinaryOperator, llvm::FreezeInst>(at)))
    return nullptr;
  llvm::SmallVector<llvm::Constant*, 2> operands;
  for (llvm::Value* operand : at->operands()) {
    operands.push_back(value_if(operand, from, known));
    if (operands.back() == nullptr) return nullptr;
  }
  return fold_constants(*at, operands);
}

/// Whether a value does nothing but decide, or help to decide, which way `test` goes.
bool only_decides(const llvm::Value& of, const llvm::BranchInst& test) {
  return std::all_of(of.user_begin(), of.user_end(), [&](const llvm::User* user) {
    return user == &test || (llvm::isa<llvm::CmpInst, llvm::CastInst, llvm::BinaryOperator, llvm::FreezeInst>(user) &&
                             only_decides(*user, test));
  });
}

/// What comes before what, in every function that is asked about.
class order_of_blocks {
 public:
  const llvm::DominatorTree& operator()(const llvm::BasicBlock& block) {
    auto* const function = const_cast<llvm::Function*>(block.getParent());
    auto& known = known_[function];
    if (known == nullptr) known = std::make_unique<llvm::DominatorTree>(*function);
    return *known;
  }

 private:
  std::map<const llvm::Function*, std::unique_ptr<llvm::DominatorTree>> known_;
};

/// The code of a first call: `if (flag == before) { ...; flag = after; }`, at every place where it was inlined.
class first_call {
 public:
  first_call(llvm::GlobalVariable& flag, order_of_blocks& order) : flag_(flag), order_(order) {}

  /// Runs the code here. Returns whether its results are now what the variables hold from the beginning.
  bool run() {
    if (!find_flag() || !find_parts() || !run_parts() || !is_private()) return false;
    for (const auto& [variable, value] : contents_) {
      variable->setInitializer(value);
      variable->setConstant(true);  // nothing else writes it
    }
    std::set<llvm::Function*> changed;
    for (const part& one : parts_) {
      changed.insert(one.test->getFunction());
      llvm::IRBuilder<>(one.test).CreateBr(one.after);
      one.test->eraseFromParent();
    }
    for (llvm::Function* function : changed) llvm::removeUnreachableBlocks(*function);
    return true;
  }

 private:
  struct part {
    llvm::BranchInst* test;
    llvm::BasicBlock* first;
    llvm::BasicBlock* after;
  };

  [[nodiscard]] bool is_in(const part& of, const llvm::BasicBlock& block) const {
    return block.getParent() == of.first->getParent() &&
           order_(block).dominates(llvm::BasicBlockEdge(of.test->getParent(), of.first), &block);
  }

  bool find_flag() {
    if (!flag_.hasInitializer() || flag_.isConstant()) return false;
    before_ = llvm::dyn_cast<llvm::ConstantInt>(flag_.getInitializer());
    uses_ = uses_of(flag_);
    if (before_ == nullptr || !uses_.is_clear || uses_.reads.empty() || uses_.writes.empty()) return false;
    for (const llvm::Instruction* write : uses_.writes) {
      const auto* store = llvm::dyn_cast<llvm::StoreInst>(write);
      const auto* value = store == nullptr ? nullptr : llvm::dyn_cast<llvm::ConstantInt>(store->getValueOperand());
      if (value == nullptr || value->getType() != before_->getType() || (after_ != nullptr && value != after_) ||
          value == before_)
        return false;
      after_ = value;
    }
    return true;
  }

  bool find_parts() {
    for (const llvm::Instruction* read : uses_.reads) {
      if (read->getType() != before_->getType()) return false;
      auto* test = llvm::dyn_cast<llvm::BranchInst>(const_cast<llvm::Instruction*>(read->getParent()->getTerminator()));
      if (test == nullptr || test->isUnconditional() || test->getSuccessor(0) == test->getSuccessor(1) ||
          !only_decides(*read, *test))
        return false;
      const auto* at_first = llvm::dyn_cast_or_null<llvm::ConstantInt>(value_if(test->getCondition(), *read, before_));
      const auto* later = llvm::dyn_cast_or_null<llvm::ConstantInt>(value_if(test->getCondition(), *read, after_));
      if (at_first == nullptr || later == nullptr || at_first == later) return false;
      part one{test, test->getSuccessor(at_first->isZero() ? 1 : 0), test->getSuccessor(later->isZero() ? 1 : 0)};
      for (const llvm::BasicBlock& block : *test->getFunction())
        if (is_in(one, block)) inside_.insert(&block);
      parts_.push_back(one);
    }
    return are_all_in(uses_.writes, inside_);
  }

  bool run_parts() {
    for (part& one : parts_) {
      compile_time_run run(*flag_.getParent());
      const compile_time_run::edge end = run.run_part(*one.first, *one.test->getParent(),
                                                      [&](const llvm::BasicBlock& block) { return is_in(one, block); });
      if (end.from == nullptr || end.to != one.after) return false;
      for (const llvm::PHINode& join : one.after->phis())
        if (!is_same(run, *join.getIncomingValueForBlock(end.from),
                     *join.getIncomingValueForBlock(one.test->getParent())))
          return false;
      if (!take_contents(run)) return false;
    }
    return contents_.count(&flag_) != 0 && contents_.at(&flag_) == after_;
  }

  static bool is_same(const compile_time_run& run, const llvm::Value& at_first, const llvm::Value& later) {
    if (&at_first == &later) return true;
    const auto* computed = llvm::dyn_cast<llvm::Instruction>(&at_first);
    return computed != nullptr && run.value_of(*computed) == &later;
  }

  bool take_contents(const compile_time_run& run) {
    for (const llvm::Value* read : run.read_variables()) {
      const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(read);
      if (variable == nullptr) return false;
      const uses_of_variable uses = uses_of(*variable);
      if (!variable->isConstant() && !(uses.is_clear && are_all_in(uses.writes, inside_))) return false;
    }
    for (const llvm::Value* written : run.written_variables()) {
      auto* variable = const_cast<llvm::GlobalVariable*>(llvm::dyn_cast<llvm::GlobalVariable>(written));
      if (variable == nullptr) {  // a local variable of that code alone
        const uses_of_variable uses = uses_of(*written);
        if (!uses.is_clear || !are_all_in(uses.reads, inside_) || !are_all_in(uses.writes, inside_)) return false;
        continue;
      }
      llvm::Constant* const contents = run.contents_of(*variable, variable->getValueType());
      const auto [known, is_new] = contents_.try_emplace(variable, contents);
      if (contents == nullptr || (!is_new && known->second != contents)) return false;
    }
    return true;
  }

  /// Whether nobody could have seen what the variables held before, or changes them.
  [[nodiscard]] bool is_private() const {
    return std::all_of(contents_.begin(), contents_.end(), [&](const auto& content) {
      const uses_of_variable uses = uses_of(*content.first);
      return uses.is_clear && are_all_in(uses.writes, inside_) &&
             std::all_of(uses.reads.begin(), uses.reads.end(), [&](const llvm::Instruction* read) {
               return content.first == &flag_ || inside_.count(read->getParent()) != 0 ||
                      std::any_of(parts_.begin(), parts_.end(), [&](const part& one) {
                        return one.test->getFunction() == read->getFunction() &&
                               order_(*read->getParent()).properlyDominates(one.test->getParent(), read->getParent());
                      });
             });
    });
  }

  llvm::GlobalVariable& flag_;
  order_of_blocks& order_;
  uses_of_variable uses_;
  const llvm::ConstantInt* before_ = nullptr;
  const llvm::ConstantInt* after_ = nullptr;
  std::vector<part> parts_;
  blocks inside_;
  std::map<llvm::GlobalVariable*, llvm::Constant*> contents_;
};

bool run_first_call(llvm::Module& module) {
  order_of_blocks order;
  for (llvm::GlobalVariable& flag : module.globals())
    if (flag.getValueType()->isIntegerTy() && first_call(flag, order).run()) return true;
  return false;
}

/// A loop that needs nothing of the hardware, and whose results are constants.
class known_loop {
 public:
  known_loop(llvm::Loop& loop, llvm::LoopInfo& loops, llvm::DominatorTree& dominators, llvm::Function& process,
             std::uint64_t most_steps)
      : loop_(loop),
        loops_(loops),
        dominators_(dominators),
        process_(process),
        run_(*process.getParent(), most_steps) {}

  /// Runs the loop here and puts its results in its place.
  bool run() {
    const llvm::BasicBlock* const entry = loop_.getLoopPredecessor();
    if (entry == nullptr) return false;
    end_ = run_.run_part(*loop_.getHeader(), *entry,
                         [&](const llvm::BasicBlock& block) { return loop_.contains(&block); });
    if (end_.from == nullptr || end_.to == nullptr || !reads_constants() || !find_results()) return false;
    before_ = loop_.getLoopPreheader();
    if (before_ == nullptr) before_ = llvm::InsertPreheaderForLoop(&loop_, &dominators_, &loops_, nullptr, false);
    if (before_ == nullptr) return false;
    copy_tables();
    for (const auto& [from, value] : results_)
      from->replaceUsesWithIf(value, [&](const llvm::Use& use) {
        return !loop_.contains(llvm::cast<llvm::Instruction>(use.getUser())->getParent());
      });
    auto* const after = const_cast<llvm::BasicBlock*>(end_.to);
    for (llvm::PHINode& join : after->phis()) {
      llvm::Value* value = join.getIncomingValueForBlock(end_.from);
      if (const auto found = results_.find(llvm::dyn_cast<llvm::Instruction>(value)); found != results_.end())
        value = found->second;
      join.addIncoming(value, before_);
    }
    before_->getTerminator()->replaceSuccessorWith(loop_.getHeader(), after);
    for (llvm::PHINode& join : loop_.getHeader()->phis()) join.removeIncomingValue(before_, false);
    llvm::removeUnreachableBlocks(process_);
    for (llvm::Value* table : tables_) replace_table(*table);
    return true;
  }

 private:
  /// What it reads is in no other loop's or call's hands.
  [[nodiscard]] bool reads_constants() const {
    const std::vector<const llvm::Value*> read = run_.read_variables();
    return std::all_of(read.begin(), read.end(), [&](const llvm::Value* one) {
      const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(one);
      if (variable == nullptr) return false;
      if (variable->isConstant()) return true;
      const uses_of_variable uses = uses_of(*variable);
      return uses.is_clear && uses.writes.empty();
    });
  }

  bool find_results() {
    for (llvm::BasicBlock* block : loop_.blocks())
      for (llvm::Instruction& at : *block) {
        if (std::all_of(at.user_begin(), at.user_end(), [&](const llvm::User* user) {
              return loop_.contains(llvm::cast<llvm::Instruction>(user)->getParent());
            }))
          continue;
        llvm::Constant* const value = run_.value_of(at);
        if (value == nullptr) return false;
        results_[&at] = value;
      }
    for (const llvm::Value* written : run_.written_variables()) {
      llvm::Constant* const value = run_.contents_of(*written, type_of(*written));
      if (value == nullptr) return false;
      tables_.push_back(const_cast<llvm::Value*>(written));
      contents_.push_back(value);
    }
    return true;
  }

  static llvm::Type* type_of(const llvm::Value& variable) {
    if (const auto* global = llvm::dyn_cast<llvm::GlobalVariable>(&variable)) return global->getValueType();
    return llvm::cast<llvm::AllocaInst>(variable).getAllocatedType();
  }

  /// Instead of the loop: what it wrote comes from tables.
  void copy_tables() {
    llvm::IRBuilder<> builder(before_->getTerminator());
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      auto* const table =
          new llvm::GlobalVariable(*process_.getParent(), contents_[i]->getType(), true,
                                   llvm::GlobalValue::PrivateLinkage, contents_[i], tables_[i]->getName());
      sources_.push_back(table);
      const std::vector<bool>& written = run_.written_bytes(*tables_[i]);
      for (std::size_t begin = 0; begin < written.size();) {
        std::size_t end = begin;
        while (end < written.size() && written[end] == written[begin]) ++end;
        if (written[begin])
          builder.CreateMemCpy(
              builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), tables_[i], begin), llvm::MaybeAlign(),
              builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), table, begin), llvm::MaybeAlign(), end - begin);
        begin = end;
      }
    }
  }

  /// A variable that nobody else writes is the table itself.
  void replace_table(llvm::Value& variable) {
    const uses_of_variable uses = uses_of(variable);
    const llvm::DominatorTree dominators(process_);
    if (!uses.is_clear || !are_all_in(uses.writes, {before_}) ||
        !std::all_of(uses.writes.begin(), uses.writes.end(),
                     [](const llvm::Instruction* at) { return llvm::isa<llvm::MemCpyInst>(at); }) ||
        !std::all_of(uses.reads.begin(), uses.reads.end(), [&](const llvm::Instruction* read) {
          return dominators.properlyDominates(before_, read->getParent());
        }))
      return;
    for (const llvm::Instruction* write : uses.writes) const_cast<llvm::Instruction*>(write)->eraseFromParent();
    const auto at = std::find(tables_.begin(), tables_.end(), &variable);
    llvm::GlobalVariable* const table = sources_[static_cast<std::size_t>(at - tables_.begin())];
    drop_markers(variable);
    variable.replaceAllUsesWith(table);
  }

  /// A table has no lifetime.
  static void drop_markers(llvm::Value& address) {
    for (llvm::User* user : llvm::make_early_inc_range(address.users())) {
      auto* at = llvm::dyn_cast<llvm::Instruction>(user);
      if (at != nullptr && at->isLifetimeStartOrEnd()) at->eraseFromParent();
    }
  }

  llvm::Loop& loop_;
  llvm::LoopInfo& loops_;
  llvm::DominatorTree& dominators_;
  llvm::Function& process_;
  compile_time_run run_;
  llvm::BasicBlock* before_ = nullptr;
  compile_time_run::edge end_;
  std::map<llvm::Instruction*, llvm::Constant*> results_;
  std::vector<llvm::Value*> tables_;
  std::vector<llvm::Constant*> contents_;
  std::vector<llvm::GlobalVariable*> sources_;
};

bool run_known_loop(llvm::Function& process, analysis_managers& managers) {
  llvm::LoopInfo& loops = managers.function.getResult<llvm::LoopAnalysis>(process);
  llvm::ScalarEvolution& evolution = managers.function.getResult<llvm::ScalarEvolutionAnalysis>(process);
  llvm::DominatorTree& dominators = managers.function.getResult<llvm::DominatorTreeAnalysis>(process);
  for (llvm::Loop* loop : loops.getLoopsInPreorder()) {  // outer ones first
    const bool is_table = any_in(*loop, is_floating);
    if (!is_table && evolution.getSmallConstantMaxTripCount(loop) != 0) continue;
    const std::uint64_t most_steps = is_table ? compile_time_run::most_steps_of_a_table : most_steps_of_a_number;
    if (known_loop(*loop, loops, dominators, process, most_steps).run()) return true;
  }
  return false;
}

}  // namespace

bool run_first_calls(llvm::Module& module) {
  bool changed = false;
  while (run_first_call(module)) changed = true;
  return changed;
}

void fill_tables(llvm::Function& process, analysis_managers& managers) {
  const auto clean_up = [&] {
    managers.function.invalidate(process, llvm::PreservedAnalyses::none());
    run_passes(process, managers, early_cleanup());
  };
  if (run_first_calls(*process.getParent())) clean_up();
  while (run_known_loop(process, managers)) clean_up();
}

void compute_mathematics(llvm::Function& process, analysis_managers& managers) {
  std::vector<llvm::CallInst*> left;
  for (bool changed = true; changed;) {
    changed = false;
    left.clear();
    for (llvm::Instruction& at : llvm::make_early_inc_range(llvm::instructions(process))) {
      if (!is_mathematics(at)) continue;
      auto& call = llvm::cast<llvm::CallInst>(at);
      llvm::SmallVector<llvm::Constant*, 2> arguments;
      for (llvm::Value* argument : call.args())
        if (auto* constant = llvm::dyn_cast<llvm::Constant>(argument)) arguments.push_back(constant);
      llvm::Constant* const result =
          arguments.size() < call.arg_size()
              ? nullptr
              : call_host_mathematics(call.getCalledFunction()->getName(), call.getType(), arguments);
      if (result == nullptr && !call.use_empty()) {
        left.push_back(&call);
        continue;
      }
      if (result != nullptr) call.replaceAllUsesWith(result);
      call.eraseFromParent();
      changed = true;
    }
    if (!changed) break;
    llvm::FunctionPassManager passes;
    passes.addPass(llvm::InstSimplifyPass());
    passes.addPass(llvm::SCCPPass());
    run_passes(process, managers, std::move(passes));
  }
  if (!left.empty())
    refuse(place_of(*left.front()),
           fmt::format("'{}' of a value that is known only at run time: hardware has no floating point: use a table "
                       "that a loop over constants fills, or fixed point and hls_math.h",
                       readable_name(*left.front()->getCalledFunction())));
}

}  // namespace epiline::frontend
