#include "frontend/calls.hpp"

#include <llvm/ADT/SCCIterator.h>
#include <llvm/Analysis/CallGraph.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/InstIterator.h>

#include "frontend/source.hpp"

namespace epiline::frontend {

llvm::Function* called_by(const llvm::Instruction& instruction) {
  const auto* call = llvm::dyn_cast<llvm::CallBase>(&instruction);
  return call == nullptr ? nullptr : call->getCalledFunction();
}

bool calls_named(const llvm::Instruction& instruction, llvm::StringRef prefix) {
  const llvm::Function* const function = called_by(instruction);
  return function != nullptr && function->getName().starts_with(prefix);
}

std::vector<llvm::CallInst*> calls_of(llvm::Module& module, llvm::StringRef name, const llvm::Function* in) {
  std::vector<llvm::CallInst*> calls;
  const llvm::Function* const function = module.getFunction(name);
  if (function == nullptr) return calls;
  for (llvm::Function& caller : module)
    for (llvm::Instruction& instruction : llvm::instructions(caller))
      if (called_by(instruction) == function && (in == nullptr || in == &caller))
        calls.push_back(llvm::cast<llvm::CallInst>(&instruction));
  return calls;
}

unsigned number_in(const llvm::CallInst& call, unsigned operand) {
  return static_cast<unsigned>(llvm::cast<llvm::ConstantInt>(call.getArgOperand(operand))->getZExtValue());
}

llvm::Type* payload_type(const llvm::CallInst& call, unsigned operand) {
  return llvm::cast<llvm::GlobalVariable>(call.getArgOperand(operand)->stripPointerCasts())->getValueType();
}

std::set<const llvm::Function*> reached_from(const llvm::Function& root) {
  std::set<const llvm::Function*> reached{&root};
  std::vector<const llvm::Function*> pending{&root};
  while (!pending.empty()) {
    const llvm::Function* const function = pending.back();
    pending.pop_back();
    for (const llvm::Instruction& instruction : llvm::instructions(*function))
      if (const llvm::Function* callee = called_by(instruction); callee != nullptr && reached.insert(callee).second)
        pending.push_back(callee);
  }
  return reached;
}

std::vector<llvm::Function*> recursive_functions(llvm::Module& module) {
  std::vector<llvm::Function*> found;
  llvm::CallGraph calls(module);
  for (auto component = llvm::scc_begin(&calls); !component.isAtEnd(); ++component) {
    if (!component.hasCycle()) continue;
    for (const llvm::CallGraphNode* node : *component)
      if (llvm::Function* function = node->getFunction(); function != nullptr && !function->isDeclaration())
        found.push_back(function);
  }
  return found;
}

std::string short_name(const llvm::Function& function) {
  const llvm::DISubprogram* const program = function.getSubprogram();
  return program != nullptr ? program->getName().str() : readable_name(function);
}

}  // namespace epiline::frontend
