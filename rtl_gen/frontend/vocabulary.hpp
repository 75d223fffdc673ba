#pragma once
// The calls by which ports, memories and tables appear in the lowered LLVM IR. All take the object's number first; the
// value type is part of the name, so that one declaration has one type.
//   iN   epiline.read.iN(i32 port)                             takes one token
//   void epiline.write.iN(i32 port, iN token)
//   iN   epiline.memory.read.iN(i32 memory, i64 address)
//   void epiline.memory.write.iN(i32 memory, i64 address, iN data, i1 enable)
//   iN   epiline.table.iN(i32 table, i64 address)
// No access, and known by another name: a register's initial value that no reset brings back (#pragma HLS RESET off).
//   iN   epiline.power_up.iN(iN value)

#include <fmt/format.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>

#include <string>
#include <vector>

namespace epiline::frontend {

enum class access : std::uint8_t { none, read, write, memory_read, memory_write, table };

inline const char* prefix_of(access kind) {
  switch (kind) {
    case access::read:
      return "epiline.read.";
    case access::write:
      return "epiline.write.";
    case access::memory_read:
      return "epiline.memory.read.";
    case access::memory_write:
      return "epiline.memory.write.";
    case access::table:
      return "epiline.table.";
    case access::none:
      break;
  }
  return "";
}

/// What an instruction accesses; none for everything but the calls above.
inline access access_of(const llvm::Instruction& instruction) {
  const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
  if (call == nullptr || call->getCalledFunction() == nullptr) return access::none;
  const llvm::StringRef name = call->getCalledFunction()->getName();
  if (!name.starts_with("epiline.")) return access::none;
  for (const access kind : {access::read, access::write, access::memory_read, access::memory_write, access::table})
    if (name.starts_with(prefix_of(kind))) return kind;
  return access::none;
}

inline constexpr const char* power_up_prefix = "epiline.power_up.";

/// `value`, hidden in a call that says: at power-up only.
inline llvm::CallInst* make_power_up(llvm::IRBuilderBase& builder, llvm::Constant* value) {
  llvm::Module& module = *builder.GetInsertBlock()->getModule();
  llvm::Type* const type = value->getType();
  const std::string name = fmt::format("{}i{}", power_up_prefix, type->getIntegerBitWidth());
  llvm::FunctionCallee callee = module.getOrInsertFunction(name, llvm::FunctionType::get(type, {type}, false));
  auto* function = llvm::cast<llvm::Function>(callee.getCallee());
  function->setDoesNotThrow();
  function->setWillReturn();
  function->setDoesNotAccessMemory();
  return builder.CreateCall(callee, {value});
}

/// The value in a call of make_power_up; null for everything else.
inline const llvm::Constant* power_up_value(const llvm::Value* value) {
  const auto* call = llvm::dyn_cast<llvm::CallInst>(value);
  if (call == nullptr || call->getCalledFunction() == nullptr ||
      !call->getCalledFunction()->getName().starts_with(power_up_prefix))
    return nullptr;
  return llvm::cast<llvm::Constant>(call->getArgOperand(0));
}

/// The port, memory or table an access speaks of.
inline unsigned object_of(const llvm::Instruction& access_call) {
  const auto& call = llvm::cast<llvm::CallInst>(access_call);
  return static_cast<unsigned>(llvm::cast<llvm::ConstantInt>(call.getArgOperand(0))->getZExtValue());
}

/// Builds one access call; `value_width` is the width of what is read or written.
inline llvm::CallInst* make_access(llvm::IRBuilderBase& builder, access kind, unsigned object, unsigned value_width,
                                   const std::vector<llvm::Value*>& operands, const llvm::Twine& name = "") {
  llvm::Module& module = *builder.GetInsertBlock()->getModule();
  llvm::LLVMContext& context = module.getContext();
  const bool writes = kind == access::write || kind == access::memory_write;
  std::vector<llvm::Type*> types{builder.getInt32Ty()};
  std::vector<llvm::Value*> arguments{builder.getInt32(object)};
  for (llvm::Value* operand : operands) {
    types.push_back(operand->getType());
    arguments.push_back(operand);
  }
  llvm::Type* const result = writes ? builder.getVoidTy() : llvm::Type::getIntNTy(context, value_width);
  const std::string callee_name = fmt::format("{}i{}", prefix_of(kind), value_width);
  llvm::FunctionCallee callee = module.getOrInsertFunction(callee_name, llvm::FunctionType::get(result, types, false));
  auto* function = llvm::cast<llvm::Function>(callee.getCallee());
  function->setDoesNotThrow();
  function->setWillReturn();
  if (kind == access::table)
    function->setDoesNotAccessMemory();
  else if (kind == access::memory_read)
    function->setMemoryEffects(llvm::MemoryEffects::inaccessibleMemOnly(llvm::ModRefInfo::Ref));
  else
    function->setMemoryEffects(llvm::MemoryEffects::inaccessibleMemOnly(llvm::ModRefInfo::ModRef));
  return builder.CreateCall(callee, arguments, writes ? llvm::Twine() : name);
}

}  // namespace epiline::frontend
