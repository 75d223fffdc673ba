#include "frontend/process_objects.hpp"

#include <fmt/format.h>
#include <llvm/Demangle/Demangle.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>

#include <string>

#include "frontend/calls.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

/// Whether a call leaves what a pointer of it points at as it is.
bool only_marks(const llvm::CallBase& call) {
  if (const auto* intrinsic = llvm::dyn_cast<llvm::IntrinsicInst>(&call))
    return intrinsic->isLifetimeStartOrEnd() || intrinsic->getIntrinsicID() == llvm::Intrinsic::invariant_start;
  return calls_named(call, "__epiline_pragma_");
}

/// Whether a call is one of those that tell what a parameter of the top is.
bool only_passes(const llvm::CallBase& call) {
  return calls_named(call, "__epiline_result") || calls_named(call, "__epiline_argument") ||
         calls_named(call, "__epiline_unwritten") || calls_named(call, "__epiline_single");
}

/// Follows a pointer into everything that is done with it.
class pointer_walk {
 public:
  /// Only uses inside these functions count; empty: all do.
  explicit pointer_walk(const std::set<const llvm::Function*>& inside = {}) : inside_(inside) {}

  const llvm::Instruction* first_write = nullptr;
  const llvm::Instruction* first_use = nullptr;

  void follow(const llvm::Value* pointer) {
    if (!seen_.insert(pointer).second) return;
    for (const llvm::User* user : pointer->users()) {
      if (llvm::isa<llvm::ConstantExpr>(user)) {
        follow(user);
        continue;
      }
      const auto* instruction = llvm::dyn_cast<llvm::Instruction>(user);
      if (instruction == nullptr || (!inside_.empty() && inside_.count(instruction->getFunction()) == 0)) continue;
      visit(*instruction, pointer);
    }
  }

 private:
  void visit(const llvm::Instruction& user, const llvm::Value* pointer) {
    if (const auto* call = llvm::dyn_cast<llvm::CallBase>(&user)) return visit_call(*call, pointer);
    if (first_use == nullptr) first_use = &user;
    if (llvm::isa<llvm::GetElementPtrInst, llvm::CastInst, llvm::PHINode, llvm::SelectInst>(user)) return follow(&user);
    if (!llvm::isa<llvm::LoadInst, llvm::CmpInst>(user)) note_write(user);
  }

  void visit_call(const llvm::CallBase& call, const llvm::Value* pointer) {
    if (only_marks(call)) return;
    if (first_use == nullptr) first_use = &call;
    if (const auto* copy = llvm::dyn_cast<llvm::MemTransferInst>(&call)) {
      if (copy->getRawDest() == pointer) note_write(call);
      return;
    }
    if (calls_named(call, "__epiline_stream_write") || only_passes(call)) return;
    if (calls_named(call, "__epiline_stream_") && call.getArgOperand(0) == pointer) return;  // a stream in an object
    const llvm::Function* callee = call.getCalledFunction();
    if (callee == nullptr || callee->isDeclaration()) return note_write(call);
    for (unsigned i = 0; i < call.arg_size() && i < callee->arg_size(); ++i)
      if (call.getArgOperand(i) == pointer) follow(callee->getArg(i));
  }

  void note_write(const llvm::Instruction& at) {
    if (first_write == nullptr) first_write = &at;
  }

  const std::set<const llvm::Function*> inside_;
  std::set<const llvm::Value*> seen_;
};

/// A variable's name in the source.
std::string variable_name(const llvm::Value& object) {
  if (const auto* global = llvm::dyn_cast<llvm::GlobalVariable>(&object)) {
    llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> described;
    global->getDebugInfo(described);
    return described.empty() ? llvm::demangle(global->getName().str())
                             : described.front()->getVariable()->getName().str();
  }
  for (const llvm::DbgVariableRecord* record : llvm::findDVRDeclares(const_cast<llvm::Value*>(&object)))
    return record->getVariable()->getName().str();
  return object.getName().split('.').first.str();
}

[[noreturn]] void refuse_shared(const source_place& place, const llvm::Value& object, const llvm::CallInst& writer,
                                const std::string& other) {
  const std::string who = short_name(*writer.getCalledFunction());
  refuse(place, fmt::format("DATAFLOW: '{}' is written by the process '{}' and used by {}: processes run side by side "
                            "and share nothing but streams: send it through an hls::stream",
                            variable_name(object), who, other));
}

/// A variable of the top that a process writes may go nowhere else but into a result.
void check_local(const llvm::Value& variable, const llvm::Value& pointer, const llvm::CallInst& writer) {
  for (const llvm::User* user : pointer.users()) {
    const auto* instruction = llvm::dyn_cast<llvm::Instruction>(user);
    if (instruction == nullptr || instruction == &writer) continue;
    if (llvm::isa<llvm::GetElementPtrInst, llvm::CastInst>(instruction)) {
      check_local(variable, *instruction, writer);
    } else if (const auto* call = llvm::dyn_cast<llvm::CallBase>(instruction)) {
      const auto* copy = llvm::dyn_cast<llvm::MemIntrinsic>(call);
      if (only_marks(*call) || only_passes(*call) || (copy != nullptr && copy->getRawDest() == &pointer)) continue;
      const auto* other = llvm::dyn_cast<llvm::CallInst>(call);
      const bool process =
          other != nullptr && other->getCalledFunction() != nullptr && !other->getCalledFunction()->isDeclaration();
      refuse_shared(place_of(*call), variable, writer,
                    process ? fmt::format("the process '{}'", short_name(*other->getCalledFunction())) : "the top");
    } else if (!llvm::isa<llvm::StoreInst>(instruction) && place_of(instruction->getDebugLoc()).line != 0) {
      refuse_shared(place_of(*instruction), variable, writer, "the top");
    }
  }
}

}  // namespace

bool is_written_through(const llvm::Value& pointer) {
  pointer_walk walk;
  walk.follow(&pointer);
  return walk.first_write != nullptr;
}

std::map<const llvm::Value*, std::size_t> check_objects(const llvm::Function& top,
                                                        const std::vector<llvm::CallInst*>& calls,
                                                        const std::set<const llvm::Value*>& streams) {
  std::map<const llvm::Value*, std::size_t> writers;
  const llvm::DataLayout& layout = top.getParent()->getDataLayout();
  for (std::size_t i = 0; i < calls.size(); ++i)
    for (const llvm::Use& operand : calls[i]->args()) {
      if (!operand->getType()->isPointerTy()) continue;
      llvm::APInt offset(64, 0);
      const llvm::Value* object = operand->stripAndAccumulateConstantOffsets(layout, offset, true);
      if (!llvm::isa<llvm::AllocaInst>(object) || streams.count(object) != 0) continue;
      pointer_walk walk;
      walk.follow(calls[i]->getCalledFunction()->getArg(calls[i]->getArgOperandNo(&operand)));
      if (walk.first_write == nullptr) continue;
      check_local(*object, *object, *calls[i]);
      writers[object] = i;
    }

  for (const llvm::GlobalVariable& variable : top.getParent()->globals()) {
    if (variable.isConstant() || variable.isDeclaration() || streams.count(&variable) != 0) continue;
    std::vector<const llvm::Instruction*> uses;
    std::size_t writer = calls.size();
    for (std::size_t i = 0; i < calls.size(); ++i) {
      std::set<const llvm::Function*> inside = reached_from(*calls[i]->getCalledFunction());
      pointer_walk walk(inside);
      walk.follow(&variable);
      uses.push_back(walk.first_use);
      bool written = walk.first_write != nullptr;
      // Given by reference it is used at the call.
      for (const llvm::Use& operand : calls[i]->args())
        if (operand->stripInBoundsConstantOffsets() == &variable) {
          pointer_walk argument;
          argument.follow(calls[i]->getCalledFunction()->getArg(calls[i]->getArgOperandNo(&operand)));
          if (uses.back() == nullptr) uses.back() = calls[i];
          written = written || argument.first_write != nullptr;
        }
      if (written && writer == calls.size()) writer = i;
    }
    if (writer == calls.size()) continue;
    for (std::size_t i = 0; i < calls.size(); ++i)
      if (i != writer && uses[i] != nullptr)
        refuse_shared(place_of(*uses[i]), variable, *calls[writer],
                      fmt::format("the process '{}'", short_name(*calls[i]->getCalledFunction())));
    for (const llvm::Instruction& instruction : llvm::instructions(top))
      if (const auto* call = llvm::dyn_cast<llvm::CallBase>(&instruction);
          &instruction != calls[writer] && (call == nullptr || !only_marks(*call)))
        for (const llvm::Use& operand : instruction.operands())
          if (operand->stripInBoundsConstantOffsets() == &variable)
            refuse_shared(place_of(instruction), variable, *calls[writer], "the top");
  }
  return writers;
}

}  // namespace epiline::frontend
