#include "check/ir_text.hpp"

#include <fmt/format.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/PassManager.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Transforms/IPO/GlobalDCE.h>
#include <llvm/Transforms/Utils/Cloning.h>

#include <map>

#include "frontend/compile.hpp"
#include "frontend/function_passes.hpp"
#include "frontend/payload.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::check {

namespace {

llvm::StringRef callee_of(const llvm::CallInst& call) {
  return call.getCalledFunction() == nullptr ? "" : call.getCalledFunction()->getName();
}

/// Replaces calls in a module by those of check_ir.hpp.
class rewriter {
 public:
  explicit rewriter(llvm::Module& module) : module_(module), builder_(module.getContext()) {}

 protected:
  /// The calls of functions whose names begin so.
  std::vector<llvm::CallInst*> calls_of(llvm::StringRef prefix) {
    std::vector<llvm::CallInst*> calls;
    for (llvm::Function& function : module_)
      for (llvm::Instruction& instruction : llvm::instructions(function))
        if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
            call != nullptr && callee_of(*call).starts_with(prefix))
          calls.push_back(call);
    return calls;
  }

  /// Room for a token of `width` bits, in words.
  llvm::AllocaInst* make_room(llvm::Function& function, unsigned width) {
    llvm::IRBuilder<> entry(&*function.getEntryBlock().getFirstInsertionPt());
    return entry.CreateAlloca(entry.getIntNTy((width + 63) / 64 * 64));
  }

  /// Calls `name(arguments..., room, width)`.
  void call(const char* name, std::vector<llvm::Value*> arguments, llvm::Value* room, unsigned width,
            std::vector<llvm::Value*> more = {}) {
    if (room != nullptr) {
      arguments.push_back(room);
      arguments.push_back(builder_.getInt32(width));
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<llvm::Type*> types;
    for (const llvm::Value* argument : arguments) types.push_back(argument->getType());
    builder_.CreateCall(module_.getOrInsertFunction(name, llvm::FunctionType::get(builder_.getVoidTy(), types, false)),
                        arguments);
  }

  /// Calls for a token to be filled in, which is the result.
  llvm::Value* receive(const char* name, llvm::Function& function, const std::vector<llvm::Value*>& arguments,
                       unsigned width) {
    llvm::AllocaInst* const room = make_room(function, width);
    call(name, arguments, room, width);
    return builder_.CreateTrunc(builder_.CreateLoad(room->getAllocatedType(), room), builder_.getIntNTy(width));
  }

  void send(const char* name, llvm::Function& function, const std::vector<llvm::Value*>& arguments, llvm::Value* token,
            const std::vector<llvm::Value*>& more = {}) {
    const unsigned width = token->getType()->getIntegerBitWidth();
    llvm::AllocaInst* const room = make_room(function, width);
    builder_.CreateStore(builder_.CreateZExt(token, room->getAllocatedType()), room);
    call(name, arguments, room, width, more);
  }

  /// Everything but the function of that name becomes private to this text; what is only declared and looked at by
  /// nobody but for its address gets a body.
  std::string finish(const char* process, const std::string& name) {
    llvm::Function& function = *module_.getFunction(process);
    function.setName(name);
    function.setLinkage(llvm::GlobalValue::ExternalLinkage);
    for (llvm::GlobalVariable& global : module_.globals()) {
      if (global.getName().starts_with("llvm.")) continue;
      if (global.isDeclaration()) global.setInitializer(llvm::Constant::getNullValue(global.getValueType()));
      if (global.hasComdat()) global.setComdat(nullptr);
      global.setLinkage(llvm::GlobalValue::InternalLinkage);
    }
    for (llvm::Function& other : module_) {
      if (&other == &function || other.isDeclaration()) continue;
      if (other.hasComdat()) other.setComdat(nullptr);
      other.setLinkage(llvm::GlobalValue::InternalLinkage);
    }
    llvm::StripDebugInfo(module_);
    frontend::analysis_managers managers;
    llvm::ModulePassManager passes;
    passes.addPass(llvm::GlobalDCEPass());
    passes.run(module_, managers.module);
    std::string text;
    llvm::raw_string_ostream out(text);
    module_.print(out, nullptr);
    return text;
  }

  llvm::Module& module_;
  llvm::IRBuilder<> builder_;
};

class source_rewriter : rewriter {
 public:
  using rewriter::rewriter;

  std::string run() {
    for (llvm::CallInst* call : calls_of("__epiline_")) {
      builder_.SetInsertPoint(call);
      replace(*call, callee_of(*call));
      if (!call->use_empty()) call->replaceAllUsesWith(llvm::Constant::getNullValue(call->getType()));
      call->eraseFromParent();
    }
    clear_variables();
    return finish(frontend::process_name, "epiline_top_for_ever");
  }

 private:
  /// What is never written is 0, as natively and in hardware: side channels that a source leaves out.
  void clear_variables() {
    for (llvm::Function& function : module_)
      for (llvm::Instruction& instruction : llvm::instructions(function))
        if (auto* slot = llvm::dyn_cast<llvm::AllocaInst>(&instruction)) {
          builder_.SetInsertPoint(slot->getNextNode());
          builder_.CreateStore(llvm::Constant::getNullValue(slot->getAllocatedType()), slot);
        }
  }

  struct payload {
    llvm::Type* type;
    std::vector<frontend::leaf> leaves;
  };
  payload payload_of(const llvm::CallInst& call) {
    llvm::Type* const type =
        llvm::cast<llvm::GlobalVariable>(call.getArgOperand(2)->stripPointerCasts())->getValueType();
    return {type, frontend::leaves_of(type, module_, {})};
  }

  void replace(llvm::CallInst& old, llvm::StringRef name) {
    llvm::Function& function = *old.getFunction();
    const bool argument = name == "__epiline_argument", read = name == "__epiline_stream_read";
    const bool result = name == "__epiline_result", write = name == "__epiline_stream_write";
    const bool unwritten = name == "__epiline_unwritten";
    if (name == "__epiline_stream_empty") {
      const llvm::FunctionCallee asks = module_.getOrInsertFunction("epiline_check_empty", old.getFunctionType());
      old.replaceAllUsesWith(builder_.CreateCall(asks, {old.getArgOperand(0)}));
      return;
    }
    if (name == "__epiline_elements") {
      old.replaceAllUsesWith(old.getArgOperand(1));
    } else if (name == "__epiline_is_given" || name == "__epiline_is_taken") {
      const llvm::FunctionCallee asks = module_.getOrInsertFunction(
          name == "__epiline_is_given" ? "epiline_check_is_given" : "epiline_check_is_taken", old.getFunctionType());
      old.replaceAllUsesWith(builder_.CreateCall(asks, {old.getArgOperand(0)}));
    } else if (argument || unwritten || read) {
      const payload of = payload_of(old);
      llvm::Value* const token = receive(argument    ? "epiline_check_argument"
                                         : unwritten ? "epiline_check_unwritten"
                                                     : "epiline_check_read",
                                         function, {old.getArgOperand(0)}, frontend::width_of(of.leaves));
      frontend::unpack_token(builder_, token, old.getArgOperand(1), of.type, of.leaves);
    } else if (result || write) {
      const payload of = payload_of(old);
      send(result ? "epiline_check_result" : "epiline_check_write", function, {old.getArgOperand(0)},
           frontend::pack_token(builder_, old.getArgOperand(1), of.type, of.leaves));
    } else if (name == "__epiline_port") {
      call("epiline_check_port", {old.getArgOperand(0), old.getArgOperand(1)}, nullptr, 0);
    }
  }
};

class process_rewriter : rewriter {
 public:
  process_rewriter(llvm::Module& module, const frontend::lowered_process& lowered)
      : rewriter(module), lowered_(lowered) {}

  lowered_text run(const std::string& name) {
    // What ran before the process has run, in the compiler.
    for (const char* list : {"llvm.global_ctors", "llvm.global_dtors", "llvm.used", "llvm.compiler.used"})
      if (llvm::GlobalVariable* global = module_.getGlobalVariable(list)) global->eraseFromParent();
    lowered_text result;
    for (llvm::CallInst* call : calls_of("epiline.")) {
      builder_.SetInsertPoint(call);
      if (llvm::Value* value = replace(*call, result.writes); value != nullptr) call->replaceAllUsesWith(value);
      call->eraseFromParent();
    }
    for (llvm::CallInst* call : calls_of("__epiline_")) call->eraseFromParent();  // marks
    result.text = finish(frontend::process_name, name);
    return result;
  }

 private:
  llvm::Value* replace(llvm::CallInst& old, std::vector<frontend::source_place>& writes) {
    llvm::Function& function = *old.getFunction();
    const unsigned object = frontend::power_up_value(&old) != nullptr ? 0 : frontend::object_of(old);
    switch (frontend::access_of(old)) {
      case frontend::access::read:
        return receive("epiline_check_port_read", function, {builder_.getInt32(object)},
                       old.getType()->getIntegerBitWidth());
      case frontend::access::write:
        writes.push_back(frontend::place_of(old));
        send("epiline_check_port_write", function, {builder_.getInt32(object)}, old.getArgOperand(1),
             {builder_.getInt32(static_cast<unsigned>(writes.size()))});
        return nullptr;
      case frontend::access::memory_read:
        return load(memory(object), lowered_.memories[object].words, old.getArgOperand(1), old.getType());
      case frontend::access::memory_write: {
        const dataflow::memory& of = lowered_.memories[object];
        const place at = place_in(memory(object), of.words, old.getArgOperand(1));
        llvm::Value* const enable = builder_.CreateAnd(at.exists, old.getArgOperand(3));
        llvm::Value* const word = builder_.CreateZExt(old.getArgOperand(2), at.type);
        builder_.CreateStore(builder_.CreateSelect(enable, word, builder_.CreateLoad(at.type, at.pointer)), at.pointer);
        return nullptr;
      }
      case frontend::access::table:
        return load(table(object), lowered_.tables[object].values.size(), old.getArgOperand(1), old.getType());
      case frontend::access::none:
        break;
    }
    return old.getArgOperand(0);  // a register's value at power-up
  }

  struct place {
    llvm::Type* type;
    llvm::Value* pointer;
    llvm::Value* exists;  // an address past the end has no word
  };
  place place_in(llvm::GlobalVariable* words, std::uint64_t count, llvm::Value* address) {
    const unsigned width = std::max(64u, address->getType()->getIntegerBitWidth());
    llvm::Value* const wide = builder_.CreateZExt(address, builder_.getIntNTy(width));
    llvm::Value* const exists = builder_.CreateICmpULT(wide, llvm::ConstantInt::get(wide->getType(), count));
    llvm::Value* const index = builder_.CreateTrunc(
        builder_.CreateSelect(exists, wide, llvm::ConstantInt::get(wide->getType(), 0)), builder_.getInt64Ty());
    auto* array = llvm::cast<llvm::ArrayType>(words->getValueType());
    return {array->getElementType(), builder_.CreateInBoundsGEP(array, words, {builder_.getInt64(0), index}), exists};
  }
  llvm::Value* load(llvm::GlobalVariable* words, std::uint64_t count, llvm::Value* address, llvm::Type* type) {
    const place at = place_in(words, count, address);
    llvm::Value* const word = builder_.CreateTrunc(builder_.CreateLoad(at.type, at.pointer), type);
    return builder_.CreateSelect(at.exists, word, llvm::Constant::getNullValue(type));
  }

  llvm::GlobalVariable* variable(std::map<unsigned, llvm::GlobalVariable*>& known, unsigned number, std::uint64_t words,
                                 unsigned width, const std::vector<llvm::APInt>& values, const char* name) {
    llvm::GlobalVariable*& found = known[number];
    if (found != nullptr) return found;
    llvm::Type* const word = builder_.getIntNTy((width + 63) / 64 * 64);
    auto* array = llvm::ArrayType::get(word, std::max<std::uint64_t>(words, 1));
    std::vector<llvm::Constant*> initial;
    for (const llvm::APInt& value : values)
      initial.push_back(llvm::ConstantInt::get(word, value.zext(word->getIntegerBitWidth())));
    llvm::Constant* const contents =
        initial.empty() ? llvm::Constant::getNullValue(array) : llvm::ConstantArray::get(array, initial);
    found = new llvm::GlobalVariable(module_, array, false, llvm::GlobalValue::InternalLinkage, contents,
                                     fmt::format("epiline.{}.{}", name, number));
    return found;
  }
  llvm::GlobalVariable* memory(unsigned number) {
    const dataflow::memory& of = lowered_.memories[number];
    return variable(memories_, number, of.words, of.width, of.initial, "memory");
  }
  llvm::GlobalVariable* table(unsigned number) {
    const dataflow::table& of = lowered_.tables[number];
    return variable(tables_, number, of.values.size(), of.width, of.values, "table");
  }

  const frontend::lowered_process& lowered_;
  std::map<unsigned, llvm::GlobalVariable*> memories_, tables_;
};

}  // namespace

std::string executable_source(const llvm::Module& module) {
  const std::unique_ptr<llvm::Module> copy = llvm::CloneModule(module);
  return source_rewriter(*copy).run();
}

std::string process_function(std::size_t process) { return fmt::format("epiline_process_{}", process); }

lowered_text executable_process(const frontend::lowered_process& lowered, std::size_t process) {
  const std::unique_ptr<llvm::Module> copy = llvm::CloneModule(*lowered.function->getParent());
  return process_rewriter(*copy, lowered).run(process_function(process));
}

}  // namespace epiline::check
