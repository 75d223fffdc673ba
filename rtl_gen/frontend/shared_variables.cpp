#include "frontend/shared_variables.hpp"

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>

#include <algorithm>

#include "frontend/calls.hpp"
#include "frontend/element_loop.hpp"
#include "frontend/payload.hpp"
#include "frontend/process_objects.hpp"

namespace epiline::frontend {

namespace {

constexpr std::uint64_t widest_token = 512;  // bits of a variable, or of an array's element, that travel in one clock

std::uint64_t bits_of(llvm::Type* type) {
  return sum_of_scalars(type, [](llvm::Type* scalar) -> std::uint64_t {
    return scalar->isIntegerTy() ? scalar->getIntegerBitWidth() : 2 * widest_token;  // nothing else can be sent
  });
}

/// What travels at once; null: the variable cannot be sent.
llvm::Type* token_type(llvm::Type* type) {
  if (bits_of(type) <= widest_token) return type;
  auto* array = llvm::dyn_cast<llvm::ArrayType>(type);
  return array == nullptr ? nullptr : token_type(array->getElementType());
}

/// Follows what is computed from a variable of the top to the processes.
class use_search {
 public:
  explicit use_search(const std::vector<llvm::CallInst*>& calls) : calls_(calls) {}

  std::set<std::size_t> users;
  bool is_kept = false;  // in a variable that outlives the call

  void follow(const llvm::Value& start) {
    pending_.push_back(&start);
    while (!pending_.empty()) {
      const llvm::Value* value = pending_.back();
      pending_.pop_back();
      if (!seen_.insert(value).second) continue;
      for (const llvm::User* user : value->users()) visit(*user, *value);
    }
  }

 private:
  void visit(const llvm::User& user, const llvm::Value& value) {
    const auto* instruction = llvm::dyn_cast<llvm::Instruction>(&user);
    if (instruction == nullptr || instruction->isTerminator()) return every_process();
    if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(instruction)) {
      if (store->getValueOperand() == &value) into(*store->getPointerOperand());
    } else if (const auto* copy = llvm::dyn_cast<llvm::MemTransferInst>(instruction)) {
      if (copy->getRawSource() == &value) into(*copy->getRawDest());
    } else if (const auto* call = llvm::dyn_cast<llvm::CallInst>(instruction)) {
      visit_call(*call);
    } else {
      pending_.push_back(instruction);
    }
  }

  void visit_call(const llvm::CallInst& call) {
    const auto found = std::find(calls_.begin(), calls_.end(), &call);
    if (found != calls_.end())
      users.insert(static_cast<std::size_t>(found - calls_.begin()));
    else if (calls_named(call, "__epiline_result"))
      users.insert(0);  // the first process gives what only the top itself computes
    else if (!call.getType()->isVoidTy())
      pending_.push_back(&call);
  }

  /// Something of the variable is stored in another one.
  void into(const llvm::Value& pointer) {
    const llvm::Value* const object = llvm::getUnderlyingObject(&pointer, 0);
    if (llvm::isa<llvm::AllocaInst>(object))
      pending_.push_back(object);
    else {
      is_kept = true;
      every_process();
    }
  }

  void every_process() {
    for (std::size_t i = 0; i < calls_.size(); ++i) users.insert(i);
  }

  const std::vector<llvm::CallInst*>& calls_;
  std::set<const llvm::Value*> seen_;
  std::vector<const llvm::Value*> pending_;
};

/// Whether the variable is one of those behind the top's own parameters.
bool is_parameter(const llvm::Value& pointer) {
  return std::any_of(pointer.user_begin(), pointer.user_end(), [](const llvm::User* user) {
    if (llvm::isa<llvm::GetElementPtrInst>(user)) return is_parameter(*user);
    const auto* call = llvm::dyn_cast<llvm::CallInst>(user);
    return call != nullptr && (calls_named(*call, "__epiline_result") || calls_named(*call, "__epiline_argument") ||
                               calls_named(*call, "__epiline_unwritten"));
  });
}

std::set<std::size_t> writers_of(const llvm::AllocaInst& slot, const std::vector<llvm::CallInst*>& calls,
                                 const std::vector<llvm::Instruction*>& after) {
  std::set<std::size_t> writers;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    for (unsigned k = 0; k < calls[i]->arg_size(); ++k) {
      const llvm::Value* const argument = calls[i]->getArgOperand(k);
      if (argument->getType()->isPointerTy() && llvm::getUnderlyingObject(argument, 0) == &slot &&
          is_written_through(*calls[i]->getCalledFunction()->getArg(k)))
        writers.insert(i);
    }
    if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(after[i]);
        store != nullptr && store->getPointerOperand() == &slot)
      writers.insert(i);
  }
  return writers;
}

llvm::FunctionCallee stream_function(llvm::Module& module, const char* name) {
  llvm::Type* const pointer = llvm::PointerType::get(module.getContext(), 0);
  llvm::FunctionCallee callee = module.getOrInsertFunction(
      name, llvm::FunctionType::get(llvm::Type::getVoidTy(module.getContext()), {pointer, pointer, pointer}, false));
  llvm::cast<llvm::Function>(callee.getCallee())->setDoesNotThrow();
  return callee;
}

/// The only place in a process where a scalar that it is given by reference gets its value, if it is run exactly once a
/// call: the value can go to its readers from there on, and they need not wait for the end. Null: there is none.
llvm::StoreInst* only_store(llvm::CallInst& call, const llvm::AllocaInst& slot) {
  llvm::Function& function = *call.getCalledFunction();
  llvm::Argument* argument = nullptr;
  for (unsigned k = 0; k < call.arg_size(); ++k) {
    if (!call.getArgOperand(k)->getType()->isPointerTy() ||
        llvm::getUnderlyingObject(call.getArgOperand(k), 0) != &slot)
      continue;
    if (argument != nullptr || call.getArgOperand(k) != &slot) return nullptr;
    argument = function.getArg(k);
  }
  if (argument == nullptr) return nullptr;
  llvm::StoreInst* only = nullptr;
  for (llvm::User* user : argument->users()) {
    if (llvm::isa<llvm::LoadInst>(user)) continue;
    auto* store = llvm::dyn_cast<llvm::StoreInst>(user);
    if (store == nullptr || store->getPointerOperand() != argument || only != nullptr) return nullptr;
    only = store;
  }
  const llvm::DataLayout& layout = function.getParent()->getDataLayout();
  if (only == nullptr ||
      layout.getTypeStoreSize(only->getValueOperand()->getType()) != layout.getTypeStoreSize(slot.getAllocatedType()))
    return nullptr;
  const llvm::DominatorTree dominators(function);
  const llvm::LoopInfo loops(dominators);
  if (loops.getLoopFor(only->getParent()) != nullptr) return nullptr;
  for (const llvm::BasicBlock& block : function)
    if (llvm::isa<llvm::ReturnInst>(block.getTerminator()) && !dominators.dominates(only->getParent(), &block))
      return nullptr;
  return only;
}

/// Sends or takes a variable where the builder stands, one token after another.
class transfer {
 public:
  transfer(llvm::IRBuilder<>& builder, llvm::FunctionCallee access, llvm::Value* channel, llvm::GlobalVariable* type)
      : builder_(builder), access_(access), channel_(channel), type_(type) {}

  void emit(llvm::Type* type, llvm::Value* pointer) {
    if (type == type_->getValueType()) {
      builder_.CreateCall(access_, {channel_, pointer, type_});
      return;
    }
    for_each_index(builder_, type->getArrayNumElements(), [&](llvm::Value* index) {
      emit(type->getArrayElementType(), builder_.CreateInBoundsGEP(type, pointer, {builder_.getInt64(0), index}));
    });
  }

 private:
  llvm::IRBuilder<>& builder_;
  llvm::FunctionCallee access_;
  llvm::Value* channel_;
  llvm::GlobalVariable* type_;
};

}  // namespace

std::vector<llvm::Instruction*> keep_results(llvm::Function& top, const std::vector<llvm::CallInst*>& calls) {
  std::vector<llvm::Instruction*> after;
  for (llvm::CallInst* call : calls) {
    after.push_back(call);
    if (!call->getType()->isIntegerTy() || call->use_empty()) continue;
    llvm::BasicBlock& entry = top.getEntryBlock();
    llvm::IRBuilder<> builder(&entry, entry.begin());
    llvm::AllocaInst* const slot = builder.CreateAlloca(call->getType(), nullptr, "result");
    const std::vector<llvm::User*> users(call->user_begin(), call->user_end());
    builder.SetInsertPoint(call->getNextNode());
    builder.SetCurrentDebugLocation(call->getDebugLoc());
    after.back() = builder.CreateStore(call, slot);
    llvm::Value* const again = builder.CreateLoad(call->getType(), slot);
    for (llvm::User* user : users) user->replaceUsesOfWith(call, again);
  }
  return after;
}

std::vector<shared_variable> find_shared_variables(llvm::Function& top, const std::vector<llvm::CallInst*>& calls,
                                                   const std::vector<llvm::Instruction*>& after,
                                                   const std::set<const llvm::Value*>& except) {
  std::vector<shared_variable> shared;
  llvm::Module& module = *top.getParent();
  for (llvm::Instruction& instruction : llvm::instructions(top)) {
    auto* slot = llvm::dyn_cast<llvm::AllocaInst>(&instruction);
    if (slot == nullptr || except.count(slot) != 0 || is_parameter(*slot)) continue;
    const std::set<std::size_t> writers = writers_of(*slot, calls, after);
    if (writers.empty()) continue;
    use_search uses(calls);
    uses.follow(*slot);
    llvm::Type* const token = token_type(slot->getAllocatedType());
    for (const std::size_t writer : writers)
      for (const std::size_t reader : uses.users) {
        if (reader == writer || token == nullptr) continue;
        auto* const channel = new llvm::GlobalVariable(
            module, llvm::Type::getInt8Ty(module.getContext()), false, llvm::GlobalValue::InternalLinkage,
            llvm::ConstantInt::get(llvm::Type::getInt8Ty(module.getContext()), 0), "epiline::shared");
        auto* const type = new llvm::GlobalVariable(module, token, false, llvm::GlobalValue::ExternalLinkage, nullptr,
                                                    "epiline::shared_type");
        shared.push_back({slot, writer, reader, after[writer], channel, type, uses.is_kept});
      }
  }
  return shared;
}

void pass_shared_variables(const std::vector<shared_variable>& shared, std::size_t process,
                           llvm::ValueToValueMapTy& copies) {
  for (const shared_variable& one : shared) {
    if (one.writer != process && one.reader != process) continue;
    auto* const slot = llvm::cast<llvm::AllocaInst>(copies[one.slot]);
    llvm::Module& module = *slot->getModule();
    auto* const type = llvm::cast<llvm::GlobalVariable>(copies[one.type]);
    auto* const after = llvm::cast<llvm::Instruction>(copies[one.after]);
    const bool writes = one.writer == process;
    llvm::IRBuilder<> builder(after->getNextNode());
    llvm::Value* pointer = slot;
    if (auto* call = llvm::dyn_cast<llvm::CallInst>(after);
        writes && call != nullptr && slot->getAllocatedType() == type->getValueType())
      if (llvm::StoreInst* const store = only_store(*call, *slot)) {
        builder.SetInsertPoint(store->getNextNode());
        pointer = store->getPointerOperand();
      }
    builder.SetCurrentDebugLocation(writes ? builder.GetInsertPoint()->getDebugLoc() : after->getDebugLoc());
    if (!builder.getCurrentDebugLocation()) builder.SetCurrentDebugLocation(after->getDebugLoc());
    transfer(builder, stream_function(module, writes ? "__epiline_stream_write" : "__epiline_stream_read"),
             copies[one.channel], type)
        .emit(slot->getAllocatedType(), pointer);
  }
}

}  // namespace epiline::frontend
