#include "frontend/ordered_access.hpp"

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/Analysis/ScalarEvolutionExpressions.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Module.h>

#include <algorithm>
#include <map>
#include <optional>

#include "frontend/calls.hpp"
#include "frontend/loops.hpp"

namespace epiline::frontend {

namespace {

llvm::Instruction& instruction_of(const llvm::Use& pointer) {
  return *llvm::cast<llvm::Instruction>(pointer.getUser());
}

bool is_payload(const llvm::Use& pointer) {
  const auto* call = llvm::dyn_cast<llvm::CallInst>(pointer.getUser());
  return call != nullptr && calls_named(*call, "__epiline_stream_") && call->getArgOperandNo(&pointer) == 1;
}

bool is_write(const llvm::Use& pointer) {
  const llvm::Instruction& user = instruction_of(pointer);
  return llvm::isa<llvm::StoreInst>(user) || calls_named(user, "__epiline_stream_read");
}

/// The pointers by which elements are accessed; false: the array is used for something else.
bool find_accesses(llvm::Value& array, std::vector<llvm::Use*>& accesses) {
  for (llvm::Use& use : array.uses()) {
    llvm::User* const user = use.getUser();
    if (llvm::isa<llvm::GEPOperator>(user)) {
      if (!find_accesses(*user, accesses)) return false;
      continue;
    }
    const auto* store = llvm::dyn_cast<llvm::StoreInst>(user);
    if (!llvm::isa<llvm::LoadInst>(user) && (store == nullptr || store->getValueOperand() == &array) &&
        !is_payload(use))
      return false;
    accesses.push_back(&use);
  }
  return true;
}

class order_check {
 public:
  order_check(llvm::Value& array, llvm::Type& element, std::uint64_t count, llvm::Function& function,
              llvm::FunctionAnalysisManager& analyses)
      : function_(function),
        layout_(function.getParent()->getDataLayout()),
        loops_(analyses.getResult<llvm::LoopAnalysis>(function)),
        dominators_(analyses.getResult<llvm::DominatorTreeAnalysis>(function)),
        evolution_(analyses.getResult<llvm::ScalarEvolutionAnalysis>(function)),
        array_(array),
        element_(element),
        element_bytes_(layout_.getTypeAllocSize(&element)),
        count_(count) {}

  ordered_accesses in_order(std::vector<llvm::Use*> pointers) {
    const auto is_elsewhere = [&](const llvm::Use* pointer) {
      return instruction_of(*pointer).getParent() != instruction_of(*pointers.front()).getParent() ||
             is_write(*pointer) != is_write(*pointers.front());
    };
    if (pointers.empty() || std::any_of(pointers.begin(), pointers.end(), is_elsewhere)) return {};
    std::sort(pointers.begin(), pointers.end(), [](const llvm::Use* a, const llvm::Use* b) {
      return instruction_of(*a).comesBefore(&instruction_of(*b));
    });
    pass_bytes_ = bytes_of_pass(*pointers.front());
    if (pass_bytes_ % element_bytes_ != 0 || pass_bytes_ == 0 || pass_bytes_ > most_elements * element_bytes_)
      return {};
    ordered_accesses accesses{{}, pass_bytes_ / element_bytes_};
    for (llvm::Use* pointer : pointers) {
      const std::optional<std::uint64_t> offset = offset_in_pass(*pointer);
      if (!offset || *offset % element_bytes_ + bytes_of(*pointer) > element_bytes_) return {};
      accesses.all.push_back({pointer, *offset});
    }
    if (is_write(*pointers.front()) && !write_all(accesses)) return {};
    return accesses;
  }

 private:
  static constexpr std::uint64_t most_elements = 64;  // that are variables at once

  /// From the beginning of the array.
  const llvm::SCEV* place_of_access(const llvm::Use& pointer) {
    return evolution_.getMinusSCEV(evolution_.getSCEV(pointer.get()), evolution_.getSCEV(&array_));
  }

  /// How far a place moves from one pass of the loop to the next; 0: it is not known to.
  std::uint64_t step_in(const llvm::Loop& loop, const llvm::SCEV* place) {
    const auto* steps = llvm::dyn_cast<llvm::SCEVAddRecExpr>(place);
    if (steps == nullptr || steps->getLoop() != &loop || !steps->isAffine()) return 0;
    const auto* step = llvm::dyn_cast<llvm::SCEVConstant>(steps->getStepRecurrence(evolution_));
    return step == nullptr ? 0 : step->getAPInt().getLimitedValue();
  }

  /// How far an access gets in a pass through its block; 0: it is not known.
  std::uint64_t bytes_of_pass(const llvm::Use& pointer) {
    const llvm::Loop* const loop = loops_.getLoopFor(instruction_of(pointer).getParent());
    if (loop == nullptr || loop->hasNoExitBlocks()) return element_bytes_ * count_;
    return step_in(*loop, place_of_access(pointer));
  }

  /// The offset of an access in what its pass goes through, if the passes go through the array once and in order.
  std::optional<std::uint64_t> offset_in_pass(const llvm::Use& pointer) {
    const llvm::SCEV* place = place_of_access(pointer);
    // From the innermost loop outwards: a loop's step is what the loops inside of it go through.
    std::uint64_t passed = pass_bytes_;
    const llvm::BasicBlock* block = instruction_of(pointer).getParent();
    const llvm::Loop* loop = loops_.getLoopFor(block);
    for (; loop != nullptr && !loop->hasNoExitBlocks(); loop = loop->getParentLoop()) {
      const std::uint64_t passes = passes_through(*loop, *block, dominators_, evolution_);
      if (passes == 0 || passes > count_) return {};
      if (passes > 1) {
        if (step_in(*loop, place) != passed) return {};
        place = llvm::cast<llvm::SCEVAddRecExpr>(place)->getStart();
      }
      passed *= passes;
      if (passed > element_bytes_ * count_) return {};
      block = loop->getHeader();
    }
    const llvm::BasicBlock* const end = loop != nullptr ? loop->getLoopLatch() : only_return();
    if (end == nullptr || !dominators_.dominates(block, end) || passed != element_bytes_ * count_) return {};
    const auto* offset = llvm::dyn_cast<llvm::SCEVConstant>(place);
    if (offset == nullptr || offset->getAPInt().uge(pass_bytes_)) return {};
    return offset->getAPInt().getZExtValue();
  }

  [[nodiscard]] const llvm::BasicBlock* only_return() const {
    const llvm::BasicBlock* found = nullptr;
    for (const llvm::BasicBlock& block : function_) {
      if (!llvm::isa<llvm::ReturnInst>(block.getTerminator())) continue;
      if (found != nullptr) return nullptr;
      found = &block;
    }
    return found;
  }

  std::uint64_t bytes_of(const llvm::Use& pointer) const {
    llvm::Instruction& user = instruction_of(pointer);
    if (!is_payload(pointer)) return layout_.getTypeStoreSize(llvm::getLoadStoreType(&user));
    return layout_.getTypeAllocSize(payload_type(llvm::cast<llvm::CallInst>(user), 2));
  }

  /// Whether the writes reach all numbers of the elements: the others would be as they were.
  bool write_all(const ordered_accesses& accesses) const {
    std::map<std::uint64_t, std::uint64_t> written;  // bytes, by offset
    for (const element_access& access : accesses.all)
      written[access.offset] = std::max(written[access.offset], bytes_of(*access.pointer));
    for (std::uint64_t i = 0; i < accesses.elements; ++i)
      if (!reaches_numbers(element_, i * element_bytes_, written)) return false;
    return true;
  }

  bool reaches_numbers(llvm::Type& type, std::uint64_t offset,
                       const std::map<std::uint64_t, std::uint64_t>& written) const {
    if (auto* array = llvm::dyn_cast<llvm::ArrayType>(&type)) {
      const std::uint64_t step = layout_.getTypeAllocSize(array->getElementType());
      for (std::uint64_t i = 0; i < array->getNumElements(); ++i)
        if (!reaches_numbers(*array->getElementType(), offset + i * step, written)) return false;
      return true;
    }
    if (auto* structure = llvm::dyn_cast<llvm::StructType>(&type)) {
      for (unsigned i = 0; i < structure->getNumElements(); ++i)
        if (!reaches_numbers(*structure->getElementType(i),
                             offset + layout_.getStructLayout(structure)->getElementOffset(i), written))
          return false;
      return true;
    }
    auto next = written.upper_bound(offset);
    return next != written.begin() && (--next)->first + next->second >= offset + layout_.getTypeStoreSize(&type);
  }

  llvm::Function& function_;
  const llvm::DataLayout& layout_;
  llvm::LoopInfo& loops_;
  llvm::DominatorTree& dominators_;
  llvm::ScalarEvolution& evolution_;
  llvm::Value& array_;
  llvm::Type& element_;
  const std::uint64_t element_bytes_, count_;
  std::uint64_t pass_bytes_ = 0;
};

}  // namespace

ordered_accesses accesses_in_order(llvm::Value& array, llvm::Type& element, std::uint64_t count,
                                   llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
  std::vector<llvm::Use*> pointers;
  if (!find_accesses(array, pointers)) return {};
  compute_results_of_loops(function, analyses);
  return order_check(array, element, count, function, analyses).in_order(std::move(pointers));
}

}  // namespace epiline::frontend
