#include "frontend/loops.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/AssumptionCache.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/OptimizationRemarkEmitter.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/Analysis/ScalarEvolutionExpressions.h>
#include <llvm/Analysis/SimplifyQuery.h>
#include <llvm/Analysis/TargetLibraryInfo.h>
#include <llvm/Analysis/TargetTransformInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/Local.h>
#include <llvm/Transforms/Utils/LoopRotationUtils.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>
#include <llvm/Transforms/Utils/LoopUtils.h>
#include <llvm/Transforms/Utils/ScalarEvolutionExpander.h>
#include <llvm/Transforms/Utils/UnrollLoop.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

#include "frontend/checks.hpp"
#include "frontend/source.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

using llvm::Instruction;

constexpr unsigned longest_outer_unroll = 64;    // trips of a constant loop outside of all others
constexpr unsigned longest_inner_unroll = 1024;  // trips of a constant loop inside a pipelined one
constexpr unsigned longest_marked_unroll = 16384;

bool is_port_access(const llvm::Instruction& instruction) {
  const access kind = access_of(instruction);
  return kind == access::read || kind == access::write;
}

constexpr const char* loop_of_pragma = "epiline.loop";

/// Where the loop starts in the source, as clang notes it at the loop itself; null if that was lost.
llvm::DILocation* start_in_source(const llvm::Loop& loop) {
  const llvm::MDNode* const id = loop.getLoopID();
  if (id == nullptr) return nullptr;
  for (const llvm::MDOperand& operand : id->operands())
    if (auto* place = llvm::dyn_cast_or_null<llvm::DILocation>(operand.get())) return place;
  return nullptr;
}

/// Inlining changes where a place was inlined, nothing else.
bool is_same_place(const llvm::DILocation& a, const llvm::DILocation& b) {
  return a.getLine() == b.getLine() && a.getColumn() == b.getColumn() && a.getScope() == b.getScope();
}

/// A loop is named by its header: blocks stay while loops come and go.
struct loop_marks {
  std::set<const llvm::BasicBlock*> pipelined;
  std::map<const llvm::BasicBlock*, unsigned> unrolled;  // passes side by side; 0: all
  bool whole_function = false;                           // one call is one iteration: its constant loops are unrolled
  unsigned initiation_interval = 1;
};

loop_marks take_pragmas(llvm::Function& function, const llvm::LoopInfo& loops) {
  loop_marks marks;
  std::vector<llvm::CallInst*> calls;
  for (llvm::Instruction& instruction : llvm::instructions(function))
    if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
        call != nullptr && call->getCalledFunction() != nullptr)
      if (const llvm::StringRef name = call->getCalledFunction()->getName();
          name == "__epiline_pragma_pipeline" || name == "__epiline_pragma_unroll")
        calls.push_back(call);
  for (llvm::CallInst* call : calls) {
    const llvm::Loop* loop = loops.getLoopFor(call->getParent());
    const bool pipeline = call->getCalledFunction()->getName() == "__epiline_pragma_pipeline";
    const auto* const noted = llvm::dyn_cast_or_null<llvm::DILocation>(call->getMetadata(loop_of_pragma));
    const llvm::DILocation* const start = loop == nullptr ? nullptr : start_in_source(*loop);
    if (!pipeline && noted != nullptr && start != nullptr && !is_same_place(*start, *noted)) {
      call->eraseFromParent();  // a loop of one pass, which is there no more
      continue;
    }
    // The outermost loop is the one that calls the top for ever: a pragma there is about the function as a whole.
    if (loop != nullptr && loop->getLoopDepth() > 1) {
      if (pipeline)
        marks.pipelined.insert(loop->getHeader());
      else
        marks.unrolled[loop->getHeader()] = static_cast<unsigned>(pragma_number(*call, 0, 0));
    } else if (pipeline) {
      marks.whole_function = true;
    }
    if (pipeline)
      marks.initiation_interval =
          std::max(marks.initiation_interval, static_cast<unsigned>(pragma_number(*call, 0, 1)));
    call->eraseFromParent();
  }
  return marks;
}

class unroller {
 public:
  unroller(llvm::Function& function, llvm::FunctionAnalysisManager& analyses)
      : function_(function),
        loops_(analyses.getResult<llvm::LoopAnalysis>(function)),
        evolution_(analyses.getResult<llvm::ScalarEvolutionAnalysis>(function)),
        dominators_(analyses.getResult<llvm::DominatorTreeAnalysis>(function)),
        assumptions_(analyses.getResult<llvm::AssumptionAnalysis>(function)),
        costs_(analyses.getResult<llvm::TargetIRAnalysis>(function)),
        remarks_(analyses.getResult<llvm::OptimizationRemarkEmitterAnalysis>(function)) {}

  unsigned run(bool every_loop) {
    marks_ = take_pragmas(function_, loops_);
    every_loop_ = every_loop;
    // Outer loops decide for inner ones, inner loops are unrolled first.
    for (llvm::Loop* loop : loops_) decide(*loop, every_loop || marks_.whole_function);
    const llvm::SmallVector<llvm::Loop*, 4> order = loops_.getLoopsInPreorder();
    for (auto loop = order.rbegin(); loop != order.rend(); ++loop)
      if (const auto found = chosen_.find((*loop)->getHeader()); found != chosen_.end()) unroll(**loop, found->second);
    return marks_.initiation_interval;
  }

 private:
  /// What decides about a loop.
  struct properties {
    unsigned exact = 0;     // trips, 0: not known
    unsigned most = 0;      // trips at most, 0: not known
    bool marked = false;    // with UNROLL
    unsigned factor = 0;    // that it gives, 0: all passes
    bool accesses = false;  // a stream
    bool calls = false;     // processes, which access streams
    bool stays = false;     // whatever is around it
  };

  properties properties_of(const llvm::Loop& loop) {
    properties of;
    of.exact = evolution_.getSmallConstantTripCount(&loop);
    of.most = of.exact != 0 ? of.exact : evolution_.getSmallConstantMaxTripCount(&loop);
    if (const auto mark = marks_.unrolled.find(loop.getHeader()); mark != marks_.unrolled.end()) {
      of.marked = true;
      of.factor = of.most != 0 && mark->second >= of.most ? 0 : mark->second;
    }
    for (const llvm::BasicBlock* block : loop.blocks())
      for (const llvm::Instruction& instruction : *block) {
        of.accesses = of.accesses || is_port_access(instruction);
        const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
        of.calls = of.calls || (call != nullptr && call->getCalledFunction() != nullptr &&
                                !call->getCalledFunction()->isDeclaration());
      }
    of.stays = of.marked ? of.factor != 0
                         : marks_.pipelined.count(loop.getHeader()) != 0 || of.accesses || of.most == 0 ||
                               of.most > longest_inner_unroll;
    return of;
  }

  /// Whether a loop inside stays one: unrolling around it would make many of it, which take turns all the same.
  bool keeps_inner_loop(const llvm::Loop& loop) {
    return std::any_of(loop.begin(), loop.end(), [&](const llvm::Loop* inner) {
      return properties_of(*inner).stays || keeps_inner_loop(*inner);
    });
  }

  /// Passes through the innermost body that unrolling the loop and all loops inside would make; 0: too many to count.
  std::uint64_t trips_of_nest(const llvm::Loop& loop) {
    std::uint64_t inside = 1;
    for (const llvm::Loop* inner : loop) inside = std::max(inside, trips_of_nest(*inner));
    return std::min<std::uint64_t>(inside * properties_of(loop).most, longest_marked_unroll);
  }

  void decide(llvm::Loop& loop, bool inside_kept) {
    const llvm::BasicBlock* header = loop.getHeader();
    const properties of = properties_of(loop);
    const bool fully = of.marked && of.factor == 0;
    if (fully && of.most == 0)
      refuse(place_of(loop),
             "#pragma HLS UNROLL on a loop whose number of trips is not known: bound it by a constant and leave early "
             "with a condition");
    if (of.marked && (fully ? of.most : of.factor) > longest_marked_unroll)
      refuse(place_of(loop),
             fmt::format("#pragma HLS UNROLL on a loop of up to {} trips: {} are the most: bound it by a smaller "
                         "constant, or let it stay a loop",
                         fully ? of.most : of.factor, longest_marked_unroll));
    if (!of.accesses && !of.calls && loop.hasNoExitBlocks())
      refuse(place_of(loop),
             "endless loop without stream access: it can never give a result; bound it or access a stream in it");
    bool unroll = fully;
    bool sequential = false;  // its passes take turns, and so do those of loops inside
    if (!of.stays && !of.marked) {
      const bool short_enough =
          inside_kept ? of.most <= longest_inner_unroll : of.exact != 0 && trips_of_nest(loop) <= longest_outer_unroll;
      unroll = short_enough && (every_loop_ || !keeps_inner_loop(loop));
      sequential = !unroll && !inside_kept;
    } else if (of.stays && loop.getLoopDepth() > 1) {
      sequential = !inside_kept && marks_.pipelined.count(header) == 0 && keeps_inner_loop(loop);
    }
    if (unroll)
      chosen_[header] = 0;
    else if (of.factor > 1)
      chosen_[header] = of.factor;
    const bool kept_here = !unroll && loop.getLoopDepth() > 1;
    for (llvm::Loop* inner : loop) decide(*inner, inside_kept || (kept_here && !sequential) || unroll);
  }

  /// `factor` passes become one, with a test for the end after each that can be the last; 0: all passes.
  void unroll(llvm::Loop& loop, unsigned factor) {
    const source_place place = place_of(loop);
    llvm::simplifyLoop(&loop, &dominators_, &loops_, &evolution_, &assumptions_, nullptr, false);
    llvm::formLCSSARecursively(loop, dominators_, &loops_, &evolution_);
    unsigned count = factor;
    if (count == 0) count = evolution_.getSmallConstantTripCount(&loop);
    if (count == 0) count = evolution_.getSmallConstantMaxTripCount(&loop);
    if (count == 0) return;  // only became countable by luck of analysis order: it stays a loop
    llvm::UnrollLoopOptions options{};
    options.Count = count;
    options.Force = true;
    options.AllowExpensiveTripCount = true;
    options.ForgetAllSCEV = false;
    const llvm::LoopUnrollResult result =
        llvm::UnrollLoop(&loop, options, &loops_, &evolution_, &dominators_, &assumptions_, &costs_, &remarks_, true);
    const bool done =
        factor == 0 ? result == llvm::LoopUnrollResult::FullyUnrolled : result != llvm::LoopUnrollResult::Unmodified;
    if (!done && marks_.unrolled.count(loop.getHeader()) != 0)
      refuse(place, "this loop cannot be unrolled: give it one exit and a constant number of trips");
  }

  llvm::Function& function_;
  llvm::LoopInfo& loops_;
  llvm::ScalarEvolution& evolution_;
  llvm::DominatorTree& dominators_;
  llvm::AssumptionCache& assumptions_;
  llvm::TargetTransformInfo& costs_;
  llvm::OptimizationRemarkEmitter& remarks_;
  loop_marks marks_;
  bool every_loop_ = false;
  std::map<const llvm::BasicBlock*, unsigned> chosen_;  // passes that become one; 0: all
};

}  // namespace

void note_loops_of_pragmas(llvm::Function& function) {
  const llvm::DominatorTree dominators(function);
  const llvm::LoopInfo loops(dominators);
  for (llvm::Instruction& instruction : llvm::instructions(function)) {
    const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
    if (call == nullptr || call->getCalledFunction() == nullptr ||
        call->getCalledFunction()->getName() != "__epiline_pragma_unroll" || call->hasMetadata(loop_of_pragma))
      continue;
    if (const llvm::Loop* const loop = loops.getLoopFor(call->getParent()))
      if (llvm::DILocation* const start = start_in_source(*loop)) instruction.setMetadata(loop_of_pragma, start);
  }
}

unsigned unroll_loops(llvm::Function& function, llvm::FunctionAnalysisManager& analyses, bool every_loop) {
  return unroller(function, analyses).run(every_loop);
}

void rotate_loops(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
  auto& loops = analyses.getResult<llvm::LoopAnalysis>(function);
  auto& evolution = analyses.getResult<llvm::ScalarEvolutionAnalysis>(function);
  auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
  auto& assumptions = analyses.getResult<llvm::AssumptionAnalysis>(function);
  auto& costs = analyses.getResult<llvm::TargetIRAnalysis>(function);
  const llvm::SimplifyQuery query(function.getParent()->getDataLayout(), nullptr, &dominators, &assumptions);
  const llvm::SmallVector<llvm::Loop*, 4> order = loops.getLoopsInPreorder();
  for (auto at = order.rbegin(); at != order.rend(); ++at) {
    llvm::Loop& loop = **at;
    bool accesses = false;
    for (const llvm::Instruction& instruction : *loop.getHeader())
      accesses = accesses || access_of(instruction) != access::none;
    if (accesses || loop.getHeader()->size() > 64) continue;
    llvm::simplifyLoop(&loop, &dominators, &loops, &evolution, &assumptions, nullptr, false);
    llvm::formLCSSARecursively(loop, dominators, &loops, &evolution);
    llvm::LoopRotation(&loop, &loops, &costs, &assumptions, &dominators, &evolution, nullptr, query, false, 1000, true);
  }
}

std::uint64_t passes_through(const llvm::Loop& loop, const llvm::BasicBlock& block,
                             const llvm::DominatorTree& dominators, llvm::ScalarEvolution& evolution) {
  const llvm::BasicBlock* const latch = loop.getLoopLatch();
  const llvm::BasicBlock* const exiting = loop.getExitingBlock();
  if (latch == nullptr || !dominators.dominates(&block, latch)) return 0;
  // A loop that is left at its end, or at its beginning before anything is done.
  const bool at_end = exiting == latch, at_beginning = exiting == loop.getHeader() && &block != exiting;
  const auto* again = llvm::dyn_cast<llvm::SCEVConstant>(evolution.getBackedgeTakenCount(&loop));
  if ((!at_end && !at_beginning) || again == nullptr) return 0;
  constexpr std::uint64_t most = std::uint64_t{1} << 40;
  return again->getAPInt().getLimitedValue(most) + (at_end ? 1 : 0);
}

void compute_results_of_loops(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
  auto& loops = analyses.getResult<llvm::LoopAnalysis>(function);
  auto& evolution = analyses.getResult<llvm::ScalarEvolutionAnalysis>(function);
  auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
  auto& assumptions = analyses.getResult<llvm::AssumptionAnalysis>(function);
  auto& costs = analyses.getResult<llvm::TargetIRAnalysis>(function);
  auto& library = analyses.getResult<llvm::TargetLibraryAnalysis>(function);
  llvm::SCEVExpander expander(evolution, function.getParent()->getDataLayout(), "result");
  llvm::SmallVector<llvm::WeakTrackingVH, 16> dead;
  const llvm::SmallVector<llvm::Loop*, 4> order = loops.getLoopsInPreorder();
  for (auto at = order.rbegin(); at != order.rend(); ++at) {  // what an inner loop leaves before what is made of it
    llvm::Loop& loop = **at;
    if (!llvm::isa<llvm::SCEVConstant>(evolution.getBackedgeTakenCount(&loop))) continue;
    llvm::simplifyLoop(&loop, &dominators, &loops, &evolution, &assumptions, nullptr, false);
    llvm::formLCSSA(loop, dominators, &loops, &evolution);
    llvm::rewriteLoopExitValues(&loop, &loops, &library, &evolution, &costs, expander, &dominators, llvm::AlwaysRepl,
                                dead);
  }
  expander.clear();
  llvm::RecursivelyDeleteTriviallyDeadInstructionsPermissive(dead);
  analyses.invalidate(function, llvm::PreservedAnalyses::none());
}

namespace {

/// The increment of a counter by a constant that decides something in the loop, or null.
llvm::BinaryOperator* deciding_increment(const llvm::PHINode& counter, const llvm::Loop& loop) {
  auto* next = llvm::dyn_cast<llvm::BinaryOperator>(counter.getIncomingValueForBlock(loop.getLoopLatch()));
  if (next == nullptr || next->getOpcode() != Instruction::Add || next->getOperand(0) != &counter ||
      !llvm::isa<llvm::ConstantInt>(next->getOperand(1)))
    return nullptr;
  for (const llvm::User* user : next->users())
    if (user != &counter) return next;
  return nullptr;
}

}  // namespace

void look_ahead(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
  auto& loops = analyses.getResult<llvm::LoopAnalysis>(function);
  auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
  auto& assumptions = analyses.getResult<llvm::AssumptionAnalysis>(function);
  for (llvm::Loop* loop : loops.getLoopsInPreorder()) {
    llvm::simplifyLoop(loop, &dominators, &loops, nullptr, &assumptions, nullptr, false);
    llvm::BasicBlock* const before = loop->getLoopPreheader();
    llvm::BasicBlock* const latch = loop->getLoopLatch();
    if (before == nullptr || latch == nullptr) continue;
    std::vector<llvm::PHINode*> counters;
    for (llvm::PHINode& phi : loop->getHeader()->phis())
      if (phi.getNumIncomingValues() == 2 && phi.getType()->isIntegerTy()) counters.push_back(&phi);
    for (llvm::PHINode* counter : counters) {
      llvm::BinaryOperator* const next = deciding_increment(*counter, *loop);
      if (next == nullptr) continue;
      llvm::Value* const step = next->getOperand(1);
      llvm::IRBuilder<> builder(before->getTerminator());
      llvm::Value* const first = builder.CreateAdd(counter->getIncomingValueForBlock(before), step);
      builder.SetInsertPoint(counter);
      llvm::PHINode* const ahead =
          builder.CreatePHI(counter->getType(), 2, counter->getName().split('.').first + "_next");
      builder.SetInsertPoint(latch->getTerminator());
      builder.SetCurrentDebugLocation(next->getDebugLoc());
      ahead->addIncoming(first, before);
      ahead->addIncoming(builder.CreateAdd(ahead, step), latch);
      next->replaceAllUsesWith(ahead);
      next->eraseFromParent();
    }
  }
}

void narrow_counters(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
  auto& loops = analyses.getResult<llvm::LoopAnalysis>(function);
  auto& evolution = analyses.getResult<llvm::ScalarEvolutionAnalysis>(function);
  std::vector<std::pair<llvm::PHINode*, unsigned>> counters;
  for (llvm::Loop* loop : loops.getLoopsInPreorder())
    for (llvm::PHINode& phi : loop->getHeader()->phis()) {
      if (!phi.getType()->isIntegerTy() || !evolution.isSCEVable(phi.getType())) continue;
      const llvm::SCEV* const values = evolution.getSCEV(&phi);
      if (!llvm::isa<llvm::SCEVAddRecExpr>(values)) continue;
      const unsigned needed = std::max(1u, evolution.getUnsignedRangeMax(values).getActiveBits());
      if (needed < phi.getType()->getIntegerBitWidth()) counters.emplace_back(&phi, needed);
    }
  for (const auto& [phi, width] : counters) {
    llvm::IRBuilder<> builder(phi->getParent(), phi->getParent()->getFirstInsertionPt());
    llvm::Value* const low = builder.CreateTrunc(phi, builder.getIntNTy(width), phi->getName());
    llvm::Value* const same = builder.CreateZExt(low, phi->getType());
    phi->replaceUsesWithIf(same, [low = low](const llvm::Use& use) { return use.getUser() != low; });
  }
}

}  // namespace epiline::frontend
