#include "frontend/checks.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/Demangle/Demangle.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>

#include <map>
#include <string>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/host_mathematics.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

/// Every function that `process` calls, directly or not, with the call by which it was found first.
using called_functions = std::map<const llvm::Function*, const llvm::CallBase*>;

called_functions find_called(const llvm::Function& process) {
  called_functions found = {{&process, nullptr}};
  std::vector<const llvm::Function*> pending = {&process};
  while (!pending.empty()) {
    const llvm::Function* function = pending.back();
    pending.pop_back();
    for (const llvm::Instruction& instruction : llvm::instructions(*function))
      for (const llvm::Use& operand : instruction.operands()) {
        const auto* callee = llvm::dyn_cast<llvm::Function>(operand->stripPointerCasts());
        if (callee != nullptr && found.try_emplace(callee, llvm::dyn_cast<llvm::CallBase>(&instruction)).second)
          pending.push_back(callee);
      }
  }
  return found;
}

/// The function's own place or, for code of a library, that of the user's line that leads to it.
source_place users_place(const llvm::Function& function, const called_functions& called) {
  source_place place = is_users(function) ? place_of(function) : source_place{};
  for (const llvm::Function* at = &function; place.line == 0;) {
    const llvm::CallBase* call = called.at(at);
    if (call == nullptr) break;
    place = place_of(call->getDebugLoc());
    at = call->getFunction();
  }
  return place;
}

void check_recursion(llvm::Module& module, const called_functions& called) {
  for (const llvm::Function* function : recursive_functions(module))
    if (called.count(function) != 0)
      refuse(users_place(*function, called),
             fmt::format("recursion in '{}': hardware has no call stack: write a loop, or recursion over template "
                         "parameters",
                         readable_name(*function)));
}

bool is_heap(llvm::StringRef name) {
  return name == "malloc" || name == "free" || name == "calloc" || name == "realloc" || name.starts_with("_Znw") ||
         name.starts_with("_Zna") || name.starts_with("_Zdl") || name.starts_with("_Zda");
}

void check_call(const llvm::CallBase& call) {
  if (call.isInlineAsm()) refuse(place_of(call), "inline assembly is not supported: write it in C++");
  const llvm::Function* callee = call.getCalledFunction();
  if (callee == nullptr)
    refuse(place_of(call),
           "a call through a pointer (function pointer or virtual function) that is not known at compile time: call "
           "the function directly, or use a template parameter");
  const llvm::StringRef name = callee->getName();
  if (name.starts_with("__epiline_")) return;
  if (is_heap(name))
    refuse(place_of(call),
           fmt::format("heap memory ('{}'): hardware has none: use arrays of constant size", readable_name(*callee)));
  if (is_host_mathematics(name)) return;  // of constants, when loops are unrolled: see compute_mathematics()
  if (call.doesNotReturn()) return;       // abort, a failed assertion: such a path is never taken
  refuse(place_of(call), fmt::format("call of '{}', which has no definition in this source: define it, or keep it "
                                     "out of the synthesis build with #ifndef __SYNTHESIS__",
                                     readable_name(*callee)));
}

/// A variable as the user named it, without its function or the number of a copy by inlining.
std::string short_name(const llvm::Value& variable) {
  llvm::StringRef name = variable.getName();
  if (!llvm::isa<llvm::GlobalValue>(variable)) return name.split('.').first.str();
  const std::string whole = llvm::demangle(name.str());
  name = whole;
  const std::size_t scope = name.rfind("::");
  return (scope == llvm::StringRef::npos ? name : name.drop_front(scope + 2)).str();
}

void check_memory_operation(const llvm::Instruction& at) {
  const llvm::Value* pointer = llvm::getLoadStorePointerOperand(&at);
  if (llvm::isa<llvm::AtomicRMWInst>(at) || llvm::isa<llvm::AtomicCmpXchgInst>(at) || at.isAtomic())
    refuse(place_of(at),
           "an atomic operation: every iteration is one already, nothing runs beside it: use a plain variable");
  if (at.isVolatile())
    refuse(place_of(at), fmt::format("'{}' is volatile: nothing outside can see or change it: exchange values with the "
                                     "outside through streams",
                                     short_name(*llvm::getUnderlyingObject(pointer))));
}

void check_variables(const llvm::Instruction& at) {
  for (const llvm::Use& operand : at.operands()) {
    const auto* global = llvm::dyn_cast<llvm::GlobalVariable>(operand->stripInBoundsConstantOffsets());
    if (global == nullptr) continue;
    const std::string name = llvm::demangle(global->getName().str());
    if (global->isThreadLocal())
      refuse(place_of(at),
             fmt::format("'{}' is thread_local: hardware has no threads: make it static", short_name(*global)));
    if (global->isDeclaration() && llvm::StringRef(name).starts_with("std::"))
      refuse(place_of(at), fmt::format("'{}' of the library is not in this source: keep it out of the synthesis build "
                                       "with #ifndef __SYNTHESIS__",
                                       name));
    if (global->isDeclaration() && !llvm::StringRef(name).starts_with("epiline::"))
      refuse(place_of(at), fmt::format("'{}' is declared but not defined in this source: define it here", name));
  }
}

}  // namespace

void check_functions(llvm::Module& module, const llvm::Function& process) {
  const called_functions called = find_called(process);
  check_recursion(module, called);
  for (const auto& [function, call] : called) {
    const source_place place = users_place(*function, called);
    if (call != nullptr && call->hasFnAttr(llvm::Attribute::ReturnsTwice))
      refuse(place_of(*call), "setjmp: hardware has no call stack to come back to: use return values");
    if (function->isDeclaration()) continue;
    if (function->isVarArg())
      refuse(place, fmt::format("'{}' takes a variable number of arguments: use a template with a parameter pack",
                                readable_name(*function)));
    for (const llvm::BasicBlock& block : *function)
      if (llvm::isa<llvm::IndirectBrInst>(block.getTerminator()))
        refuse(place_of(*(block.hasNPredecessors(0) ? &block : *llvm::pred_begin(&block))->getTerminator()),
               "a goto to a place computed at run time: use switch");
  }
}

void check_operations(const llvm::Function& process) {
  for (const llvm::Instruction& instruction : llvm::instructions(process)) {
    if (llvm::isa<llvm::InvokeInst>(instruction)) refuse(place_of(instruction), "exceptions are not supported");
    if (const auto* slot = llvm::dyn_cast<llvm::AllocaInst>(&instruction);
        slot != nullptr && slot->isArrayAllocation() && !llvm::isa<llvm::ConstantInt>(slot->getArraySize()))
      refuse(place_of(instruction),
             "the size of an array is known only at run time: give it the largest size as a constant");
    if (instruction.getType()->getScalarType()->isFloatingPointTy() && instruction.getType()->isVectorTy())
      refuse(place_of(instruction), "floating point in a struct: use ap_fixed or ap_int instead");  // in C's registers
    if (instruction.getType()->isVectorTy())
      refuse(place_of(instruction), "a vector type of the compiler: use an array and a loop over it");
    check_memory_operation(instruction);
    check_variables(instruction);
    if (const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
        call != nullptr && !llvm::isa<llvm::IntrinsicInst>(call))
      check_call(*call);
  }
}

void check_endless_loops(const llvm::LoopInfo& loops) {
  for (const llvm::Loop* loop : loops.getLoopsInPreorder()) {
    if (!loop->hasNoExitBlocks()) continue;
    bool accesses = false;
    for (const llvm::BasicBlock* block : loop->blocks())
      for (const llvm::Instruction& instruction : *block)
        if (const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
            call != nullptr && call->getCalledFunction() != nullptr)
          accesses = accesses || (call->getCalledFunction()->getName().starts_with("__epiline_") &&
                                  !call->getCalledFunction()->getName().starts_with("__epiline_pragma_"));
    if (accesses) continue;
    refuse(place_of(*loop),
           "endless loop without stream access: it can never give a result; bound it or access a stream in it");
  }
}

bool is_no_number(const llvm::CallInst& call) {
  return call.getCalledFunction() != nullptr && call.getCalledFunction()->getName() == "__epiline_no_number";
}

void refuse_no_numbers(const llvm::Function& process) {
  for (const llvm::Instruction& instruction : llvm::instructions(process))
    if (const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction); call != nullptr && is_no_number(*call))
      refuse(place_of(instruction),
             "text or floating point that is no number, or is known only at run time: give a constant number");
}

int pragma_number(const llvm::CallInst& call, unsigned argument, int least) {
  const auto* number = llvm::dyn_cast<llvm::ConstantInt>(call.getArgOperand(argument));
  const std::string pragma =
      call.getCalledFunction()->getName().drop_front(llvm::StringRef("__epiline_pragma_").size()).upper();
  if (number == nullptr)
    refuse(place_of(call),
           fmt::format("#pragma HLS {}: its number is not known at compile time: give a constant", pragma));
  if (number->getSExtValue() < least)
    refuse(place_of(call),
           fmt::format("#pragma HLS {}: its number is {}: give {} or more", pragma, number->getSExtValue(), least));
  return static_cast<int>(number->getSExtValue());
}

void check_initial_values(const std::set<const llvm::GlobalVariable*>& unknown, const llvm::Function& process) {
  for (const llvm::Instruction& instruction : llvm::instructions(process))
    for (const llvm::Use& operand : instruction.operands()) {
      const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(operand->stripInBoundsConstantOffsets());
      if (variable == nullptr || unknown.count(variable) == 0) continue;
      refuse(
          place_of(instruction),
          fmt::format("'{}' gets its value when a program starts, from code that cannot be run here: make it constexpr",
                      llvm::demangle(variable->getName().str())));
    }
}

}  // namespace epiline::frontend
