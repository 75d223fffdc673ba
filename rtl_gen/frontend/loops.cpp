#include "frontend/loops.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/AssumptionCache.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/OptimizationRemarkEmitter.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/Analysis/ScalarEvolutionExpressions.h>
#include <llvm/Analysis/SimplifyQuery.h>
#include <llvm/Analysis/TargetTransformInfo.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/LoopRotationUtils.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>
#include <llvm/Transforms/Utils/LoopUtils.h>
#include <llvm/Transforms/Utils/UnrollLoop.h>

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

/// A loop is named by its header: blocks stay while loops come and go.
struct loop_marks {
  std::set<const llvm::BasicBlock*> pipelined;
  std::set<const llvm::BasicBlock*> unrolled;
  bool whole_function = false;  // one call is one iteration: its constant loops are unrolled
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
    // The outermost loop is the one that calls the top for ever: a pragma there is about the function as a whole.
    if (loop != nullptr && loop->getLoopDepth() > 1)
      (pipeline ? marks.pipelined : marks.unrolled).insert(loop->getHeader());
    else if (pipeline)
      marks.whole_function = true;
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
    // Outer loops decide for inner ones, inner loops are unrolled first.
    for (llvm::Loop* loop : loops_) decide(*loop, every_loop || marks_.whole_function);
    const llvm::SmallVector<llvm::Loop*, 4> order = loops_.getLoopsInPreorder();
    for (auto loop = order.rbegin(); loop != order.rend(); ++loop)
      if (chosen_.count((*loop)->getHeader()) != 0) unroll(**loop);
    return marks_.initiation_interval;
  }

 private:
  void decide(llvm::Loop& loop, bool inside_kept) {
    const llvm::BasicBlock* header = loop.getHeader();
    const unsigned exact = evolution_.getSmallConstantTripCount(&loop);
    const unsigned most = exact != 0 ? exact : evolution_.getSmallConstantMaxTripCount(&loop);
    const bool marked = marks_.unrolled.count(header) != 0;
    bool accesses = false;
    bool calls = false;  // processes, which access streams
    for (const llvm::BasicBlock* block : loop.blocks())
      for (const llvm::Instruction& instruction : *block) {
        accesses = accesses || is_port_access(instruction);
        const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
        calls = calls || (call != nullptr && call->getCalledFunction() != nullptr &&
                          !call->getCalledFunction()->isDeclaration());
      }
    if (marked && most == 0)
      refuse(place_of(loop),
             "#pragma HLS UNROLL on a loop whose number of trips is not known: bound it by a constant and leave early "
             "with a condition");
    if (marked && most > longest_marked_unroll)
      refuse(place_of(loop),
             fmt::format("#pragma HLS UNROLL on a loop of up to {} trips: {} are the most: bound it by a smaller "
                         "constant, or let it stay a loop",
                         most, longest_marked_unroll));
    if (!accesses && !calls && loop.hasNoExitBlocks())
      refuse(place_of(loop),
             "endless loop without stream access: it can never give a result; bound it or access a stream in it");
    bool unroll = marked;
    if (!marked && marks_.pipelined.count(header) == 0 && !accesses && most != 0)
      unroll = inside_kept ? most <= longest_inner_unroll : (exact != 0 && exact <= longest_outer_unroll);
    if (unroll) chosen_.insert(header);
    const bool kept_here = !unroll && loop.getLoopDepth() > 1;
    for (llvm::Loop* inner : loop) decide(*inner, inside_kept || kept_here || unroll);
  }

  void unroll(llvm::Loop& loop) {
    const source_place place = place_of(loop);
    llvm::simplifyLoop(&loop, &dominators_, &loops_, &evolution_, &assumptions_, nullptr, false);
    llvm::formLCSSARecursively(loop, dominators_, &loops_, &evolution_);
    unsigned count = evolution_.getSmallConstantTripCount(&loop);
    if (count == 0) count = evolution_.getSmallConstantMaxTripCount(&loop);
    if (count == 0) return;  // only became countable by luck of analysis order: it stays a loop
    llvm::UnrollLoopOptions options{};
    options.Count = count;
    options.Force = true;
    options.AllowExpensiveTripCount = true;
    options.ForgetAllSCEV = false;
    const llvm::LoopUnrollResult result =
        llvm::UnrollLoop(&loop, options, &loops_, &evolution_, &dominators_, &assumptions_, &costs_, &remarks_, true);
    if (result != llvm::LoopUnrollResult::FullyUnrolled && marks_.unrolled.count(loop.getHeader()) != 0)
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
  std::set<const llvm::BasicBlock*> chosen_;
};

}  // namespace

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
