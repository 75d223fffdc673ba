#include "frontend/data_arrays.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/ReplaceConstant.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/loops.hpp"
#include "frontend/ordered_access.hpp"

namespace epiline::frontend {

namespace {

/// What the top does with an array. What call_top.hpp does goes by way of __epiline_elements.
class array_uses {
 public:
  array_uses(const llvm::Value& array, llvm::FunctionAnalysisManager& analyses) : analyses_(analyses) { follow(array); }

  [[nodiscard]] bool is_written() const { return !writes_.empty(); }
  /// The first place where elements are read that nobody has written yet; null: there is none.
  [[nodiscard]] const llvm::Instruction* first_read_of_given() const {
    for (const llvm::Instruction* read : reads_)
      if (std::none_of(writes_.begin(), writes_.end(),
                       [&](const llvm::Instruction* write) { return comes_before(*write, *read); }))
        return read;
    return nullptr;
  }

 private:
  bool comes_before(const llvm::Instruction& write, const llvm::Instruction& read) const {
    if (write.getFunction() != read.getFunction()) return false;
    auto& function = const_cast<llvm::Function&>(*read.getFunction());  // as analyses want it; they change nothing
    const auto& dominators = analyses_.getResult<llvm::DominatorTreeAnalysis>(function);
    if (dominators.dominates(&write, &read)) return true;
    // A loop that runs has written when it has ended.
    auto& evolution = analyses_.getResult<llvm::ScalarEvolutionAnalysis>(function);
    const llvm::BasicBlock* block = write.getParent();
    const llvm::Loop* loop = analyses_.getResult<llvm::LoopAnalysis>(function).getLoopFor(block);
    for (; loop != nullptr && !loop->contains(&read); loop = loop->getParentLoop()) {
      if (passes_through(*loop, *block, dominators, evolution) == 0) return false;
      block = loop->getHeader();
    }
    return block != write.getParent() && dominators.dominates(block, read.getParent());
  }

  void follow(const llvm::Value& pointer) {
    if (!seen_.insert(&pointer).second) return;
    for (const llvm::Use& use : pointer.uses()) {
      const llvm::User* const user = use.getUser();
      if (llvm::isa<llvm::GEPOperator, llvm::CastInst, llvm::PHINode, llvm::SelectInst>(user)) {
        follow(*user);
      } else if (const auto* call = llvm::dyn_cast<llvm::CallBase>(user)) {
        visit_call(*call, use);
      } else if (const auto* instruction = llvm::dyn_cast<llvm::Instruction>(user)) {
        (llvm::isa<llvm::StoreInst>(user) ? writes_ : reads_).push_back(instruction);
      }
    }
  }

  void visit_call(const llvm::CallBase& call, const llvm::Use& use) {
    if (calls_named(call, "__epiline_elements") || calls_named(call, "__epiline_pragma_")) return;
    if (const auto* intrinsic = llvm::dyn_cast<llvm::IntrinsicInst>(&call);
        intrinsic != nullptr && intrinsic->isLifetimeStartOrEnd())
      return;
    const bool is_first = call.getArgOperandNo(&use) == 0;
    const llvm::Function* const callee = call.getCalledFunction();
    if (callee != nullptr && !callee->isDeclaration())
      follow(*callee->getArg(call.getArgOperandNo(&use)));
    else if (llvm::isa<llvm::MemIntrinsic>(call) ? is_first : calls_named(call, "__epiline_stream_read"))
      writes_.push_back(&call);
    else
      reads_.push_back(&call);
  }

  llvm::FunctionAnalysisManager& analyses_;
  std::set<const llvm::Value*> seen_;
  std::vector<const llvm::Instruction*> reads_, writes_;
};

struct data_array {
  std::string name;
  llvm::GlobalVariable* values;
  bool is_looked_at;        // what is given of it
  bool is_given, is_taken;  // in whole, before or after the call
  llvm::Value* stream = nullptr;
};

data_array describe(llvm::GlobalVariable& values, const std::string& name, llvm::FunctionAnalysisManager& analyses) {
  const array_uses uses(values, analyses);
  const llvm::Instruction* const read = uses.first_read_of_given();
  if (uses.is_written() && read != nullptr)
    refuse(
        place_of(*read),
        fmt::format("the array '{}', a parameter of the top, is read here before it is written, and written as well: a "
                    "port has one direction: give results in an array of their own, or work on a copy",
                    name));
  return {name, &values, read != nullptr, !uses.is_written(), uses.is_written()};
}

std::vector<llvm::Constant*> variables_of(const std::map<unsigned, data_array>& arrays) {
  std::vector<llvm::Constant*> variables;
  for (const auto& [index, array] : arrays) variables.push_back(array.values);
  return variables;
}

/// The call that moves a token between a stream and a variable, and tells its type.
const llvm::CallInst* transfer_of(const data_array& array, const char* name, llvm::Function& process) {
  for (const llvm::CallInst* call : calls_of(*process.getParent(), name, &process))
    if (call->getArgOperand(0)->stripPointerCasts() == array.stream->stripPointerCasts()) return call;
  return nullptr;
}

bool is_called_once(const llvm::Function& callee, const llvm::Function& process) {
  const std::set<const llvm::Function*> reached = reached_from(process);
  return std::count_if(callee.user_begin(), callee.user_end(), [&](const llvm::User* user) {
           const auto* call = llvm::dyn_cast<llvm::CallInst>(user);
           return call == nullptr || reached.count(call->getFunction()) != 0;
         }) == 1;
}

/// Where an array is used: in the top, or in the one process that it is passed to.
struct passed_array {
  llvm::Value* pointer;
  llvm::Function* function;
  llvm::Use* operand;  // of the process' call, if any
};

/// Whether a call takes place once in each call of the top: in a loop it would go through the array again.
bool takes_place_once(const llvm::CallInst& call, llvm::Function& process, llvm::FunctionAnalysisManager& analyses) {
  const llvm::Loop* const loop = analyses.getResult<llvm::LoopAnalysis>(process).getLoopFor(call.getParent());
  return call.getFunction() == &process && loop != nullptr && loop->hasNoExitBlocks() &&
         loop->getLoopLatch() != nullptr &&
         analyses.getResult<llvm::DominatorTreeAnalysis>(process).dominates(call.getParent(), loop->getLoopLatch());
}

passed_array passed_on(llvm::Value& array, llvm::Function& process, llvm::FunctionAnalysisManager& analyses) {
  if (array.hasOneUse())
    if (auto* const call = llvm::dyn_cast<llvm::CallInst>(array.user_back()))
      if (llvm::Function* const callee = called_by(*call); callee != nullptr && !callee->isDeclaration() &&
                                                           is_called_once(*callee, process) &&
                                                           takes_place_once(*call, process, analyses))
        return {callee->getArg(call->getArgOperandNo(&*array.use_begin())), callee, &*array.use_begin()};
  return {&array, &process, nullptr};
}

/// Lets the accesses of each element be one of the stream, by way of a variable of the elements of a pass.
void access_in_order(data_array& array, llvm::Function& process, llvm::FunctionAnalysisManager& analyses) {
  llvm::Type* element = array.values->getValueType();
  std::uint64_t count = 1;
  for (; element->isArrayTy(); element = element->getArrayElementType()) count *= element->getArrayNumElements();
  const passed_array where = passed_on(*array.values, process, analyses);
  const ordered_accesses accesses = accesses_in_order(*where.pointer, *element, count, *where.function, analyses);
  const llvm::CallInst* const transfer =
      transfer_of(array, array.is_given ? "__epiline_stream_read" : "__epiline_stream_write", process);
  if (accesses.all.empty() || transfer == nullptr) return;
  llvm::Value* stream = array.stream;
  if (where.operand != nullptr) {  // the process is given the stream instead
    where.operand->set(array.stream);
    stream = where.pointer;
  }
  llvm::IRBuilder<> builder(&*where.function->getEntryBlock().getFirstInsertionPt());
  auto* const type = llvm::ArrayType::get(element, accesses.elements);
  llvm::Value* const variable = builder.CreateAlloca(type, nullptr, array.name);
  auto* const access =
      llvm::cast<llvm::Instruction>((array.is_given ? accesses.all.front() : accesses.all.back()).pointer->getUser());
  builder.SetInsertPoint(array.is_given ? access : access->getNextNode());
  builder.SetCurrentDebugLocation(access->getDebugLoc());
  for (unsigned i = 0; i < accesses.elements; ++i) {
    llvm::Value* const one = builder.CreateConstInBoundsGEP2_64(type, variable, 0, i);
    llvm::CallInst* const token = builder.CreateCall(transfer->getFunctionType(), transfer->getCalledOperand(),
                                                     {stream, one, transfer->getArgOperand(2)});
    token->setAttributes(transfer->getAttributes());
  }
  for (const element_access& one : accesses.all) {
    builder.SetInsertPoint(llvm::cast<llvm::Instruction>(one.pointer->getUser()));
    one.pointer->set(builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), variable, one.offset));
  }
  array.is_given = array.is_taken = false;
}

/// In reports and in the Verilog the array is the parameter.
void rename(llvm::GlobalVariable& variable, const std::string& name, const source_place& place) {
  variable.setName(name);
  llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> described;
  variable.getDebugInfo(described);
  if (described.empty()) return;
  const llvm::DIGlobalVariable& old = *described.front()->getVariable();
  llvm::LLVMContext& context = variable.getContext();
  auto* const renamed =
      llvm::DIGlobalVariable::getDistinct(context, nullptr, name, "", llvm::DIFile::get(context, place.file, ""),
                                          place.line, old.getType(), true, true, nullptr, nullptr, 0, nullptr);
  variable.eraseMetadata(llvm::LLVMContext::MD_dbg);
  variable.addDebugInfo(llvm::DIGlobalVariableExpression::get(context, renamed, described.front()->getExpression()));
}

}  // namespace

bool connect_data_arrays(llvm::Function& process, const top_description& top, llvm::FunctionAnalysisManager& analyses,
                         bool has_processes, std::vector<std::string>& notes) {
  llvm::Module& module = *process.getParent();
  const auto index_of = [](const llvm::CallInst& call) { return number_in(call, 0); };
  std::map<unsigned, data_array> arrays;
  const std::vector<llvm::CallInst*> elements = calls_of(module, "__epiline_elements", &process);
  for (llvm::CallInst* call : elements) {
    const unsigned index = index_of(*call);
    auto& values = *llvm::cast<llvm::GlobalVariable>(call->getArgOperand(1)->stripPointerCasts());
    if (arrays.count(index) == 0) arrays.emplace(index, describe(values, top.parameters.at(index), analyses));
  }
  if (arrays.empty()) return false;

  llvm::convertUsersOfConstantsToInstructions(variables_of(arrays), &process);
  for (llvm::CallInst* call : calls_of(module, "__epiline_port", &process))
    if (const auto array = arrays.find(index_of(*call)); array != arrays.end())
      array->second.stream = call->getArgOperand(1);
  for (llvm::CallInst* call : elements)
    call->setArgOperand(1, llvm::PoisonValue::get(call->getArgOperand(1)->getType()));
  for (auto& [index, array] : arrays) {
    access_in_order(array, process, analyses);
    if (array.is_given && !array.is_looked_at)
      notes.push_back(fmt::format("{}:{}: note: the array '{}' is not used: its elements are taken before the call",
                                  top.place.file, top.place.line, array.name));
    else if (array.is_given || array.is_taken)
      notes.push_back(fmt::format(
          "{}:{}: note: the array '{}' is kept in memory, {} the call: a stream without memory "
          "takes one place that accesses each element once, in order and under no condition",
          top.place.file, top.place.line, array.name, array.is_given ? "filled before" : "and given after"));
  }

  for (llvm::CallInst* call : elements) {
    call->replaceAllUsesWith(arrays.at(index_of(*call)).values);
    call->eraseFromParent();
  }
  for (const char* question : {"__epiline_is_given", "__epiline_is_taken"})
    for (llvm::CallInst* call : calls_of(module, question, &process)) {
      const data_array& array = arrays.at(index_of(*call));
      const bool answer = question == std::string("__epiline_is_given") ? array.is_given : array.is_taken;
      call->replaceAllUsesWith(llvm::ConstantInt::getBool(call->getType(), answer));
      call->eraseFromParent();
    }
  for (const auto& [index, array] : arrays) {
    if (has_processes) {
      llvm::IRBuilder<> builder(&*process.getEntryBlock().getFirstInsertionPt());
      array.values->replaceAllUsesWith(
          builder.CreateAlloca(array.values->getValueType(), nullptr, array.name + "_values"));
    } else {
      rename(*array.values, array.name, top.place);
    }
  }
  return true;
}

}  // namespace epiline::frontend
