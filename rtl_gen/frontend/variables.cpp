#include "frontend/variables.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/ConstantFolding.h>
#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/ReplaceConstant.h>

#include "frontend/payload.hpp"

namespace epiline::frontend {

namespace {

const llvm::DIType* strip(const llvm::DIType* type) {
  while (const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type)) {
    if (derived->getTag() == llvm::dwarf::DW_TAG_pointer_type) return nullptr;
    type = derived->getBaseType();
  }
  return type;
}

std::string without_trailing_underscores(llvm::StringRef name) { return name.rtrim('_').str(); }

/// An ap_int, or a struct around nothing else: its members are no names of the user's.
bool wraps_arbitrary_precision(llvm::Type* type) {
  unsigned width = 0;
  bool is_signed = false;
  while (!is_arbitrary_precision(type, width, is_signed)) {
    auto* structure = llvm::dyn_cast<llvm::StructType>(type);
    if (structure == nullptr || structure->getNumElements() != 1) return false;
    type = structure->getElementType(0);
  }
  return true;
}

variable describe(llvm::AllocaInst& slot) {
  variable of;
  of.base = &slot;
  of.type = slot.getAllocatedType();
  of.name = without_trailing_underscores(slot.getName().split('.').first);
  for (const llvm::DbgVariableRecord* record : llvm::findDVRDeclares(&slot)) {
    of.name = without_trailing_underscores(record->getVariable()->getName());
    of.debug_type = record->getVariable()->getType();
    of.place = place_of(*record->getVariable());
  }
  if (of.name.empty()) of.name = "value";
  return of;
}

/// What stands at `offset` bytes of `whole`, as a constant of `type`; null if that cannot be told.
llvm::Constant* constant_at(llvm::Constant* whole, llvm::Type* type, std::uint64_t offset,
                            const llvm::DataLayout& layout) {
  llvm::SmallVector<llvm::Constant*> elements;
  const auto append = [&](llvm::Type* element, std::uint64_t at) {
    elements.push_back(constant_at(whole, element, at, layout));
    return elements.back() != nullptr;
  };
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
    const std::uint64_t size = layout.getTypeAllocSize(array->getElementType());
    for (std::uint64_t i = 0; i < array->getNumElements(); ++i)
      if (!append(array->getElementType(), offset + i * size)) return nullptr;
    return llvm::ConstantArray::get(array, elements);
  }
  if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
    const llvm::StructLayout* fields = layout.getStructLayout(structure);
    for (unsigned i = 0; i < structure->getNumElements(); ++i)
      if (!append(structure->getElementType(i), offset + fields->getElementOffset(i))) return nullptr;
    return llvm::ConstantStruct::get(structure, elements);
  }
  return llvm::ConstantFoldLoadFromConst(whole, type, llvm::APInt(64, offset), layout);
}

/// clang gives an array whose initial contents end in many zeros the type of a struct: a few elements, and an array of
/// zeros. Where the array is indexed, it is the array again: this makes the variable one from the beginning.
llvm::GlobalVariable& in_type_of_source(llvm::GlobalVariable& global) {
  const auto* structure = llvm::dyn_cast<llvm::StructType>(global.getValueType());
  if (structure == nullptr || !structure->isLiteral()) return global;
  const llvm::DataLayout& layout = global.getParent()->getDataLayout();
  llvm::Type* type = nullptr;
  for (const llvm::User* user : global.users()) {
    const auto* element = llvm::dyn_cast<llvm::GetElementPtrInst>(user);
    if (element == nullptr || !llvm::isa<llvm::ArrayType>(element->getSourceElementType())) continue;
    if (layout.getTypeAllocSize(element->getSourceElementType()) == layout.getTypeAllocSize(global.getValueType()))
      type = element->getSourceElementType();
  }
  llvm::Constant* initial = type == nullptr ? nullptr : constant_at(global.getInitializer(), type, 0, layout);
  if (initial == nullptr) return global;
  auto* made = new llvm::GlobalVariable(*global.getParent(), type, global.isConstant(), global.getLinkage(), initial,
                                        "", &global);
  made->takeName(&global);
  made->copyAttributesFrom(&global);
  made->copyMetadata(&global, 0);
  global.replaceAllUsesWith(made);
  global.eraseFromParent();
  return *made;
}

variable describe(llvm::GlobalVariable& global) {
  variable of;
  of.base = &global;
  of.type = global.getValueType();
  of.initial = global.getInitializer();
  of.is_constant = global.isConstant();
  of.name = without_trailing_underscores(global.getName());
  llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> expressions;
  global.getDebugInfo(expressions);
  for (const llvm::DIGlobalVariableExpression* expression : expressions) {
    of.name = without_trailing_underscores(expression->getVariable()->getName());
    of.debug_type = expression->getVariable()->getType();
    of.place = place_of(*expression->getVariable());
  }
  return of;
}

}  // namespace

std::vector<variable> find_variables(llvm::Function& function) {
  llvm::Module& module = *function.getParent();
  std::vector<variable> variables;
  std::vector<llvm::Constant*> globals;
  for (llvm::GlobalVariable& global : module.globals())
    if (global.hasInitializer() && !global.getName().starts_with("llvm.")) globals.push_back(&global);
  llvm::convertUsersOfConstantsToInstructions(globals, &function);
  for (llvm::Instruction& instruction : llvm::instructions(function))
    if (auto* slot = llvm::dyn_cast<llvm::AllocaInst>(&instruction)) variables.push_back(describe(*slot));
  for (llvm::Constant* constant : globals) {
    auto& global = *llvm::cast<llvm::GlobalVariable>(constant);
    bool used_here = false;
    for (llvm::User* user : global.users()) {
      auto* instruction = llvm::dyn_cast<llvm::Instruction>(user);
      used_here = used_here || (instruction != nullptr && instruction->getFunction() == &function);
    }
    if (used_here) variables.push_back(describe(in_type_of_source(global)));
  }
  return variables;
}

llvm::Type* step_type(const path_step& step) {
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(step.container)) return array->getElementType();
  return llvm::cast<llvm::StructType>(step.container)->getElementType(static_cast<unsigned>(step.constant));
}

std::string shape_of(const path_steps& path, std::size_t count) {
  std::string shape;
  for (std::size_t i = 0; i < count; ++i)
    shape += path[i].is_array() ? std::string("[]") : fmt::format(".{}", path[i].constant);
  return shape;
}

std::string path_name(const variable& of, const path_steps& path, const std::vector<bool>& is_address,
                      const llvm::DataLayout& layout) {
  std::string name;
  const llvm::DIType* type = strip(of.debug_type);
  unsigned dimension = 0;  // of a debug array type, which may stand for several nested ones
  for (std::size_t i = 0; i < path.size(); ++i) {
    const path_step& step = path[i];
    if (wraps_arbitrary_precision(step.container)) break;
    const auto* composite = llvm::dyn_cast_or_null<llvm::DICompositeType>(type);
    if (step.is_array()) {
      if (!is_address[i]) name += fmt::format("_{}", step.constant);
      if (composite != nullptr && ++dimension >= composite->getElements().size()) {
        type = strip(composite->getBaseType());
        dimension = 0;
      }
      continue;
    }
    const std::uint64_t offset = layout.getStructLayout(llvm::cast<llvm::StructType>(step.container))
                                     ->getElementOffset(static_cast<unsigned>(step.constant)) *
                                 8;
    const llvm::DIDerivedType* found = nullptr;
    if (composite != nullptr)
      for (const llvm::DINode* element : composite->getElements()) {
        const auto* member = llvm::dyn_cast<llvm::DIDerivedType>(element);
        if (member == nullptr || member->isStaticMember() || member->getOffsetInBits() != offset) continue;
        if (member->getTag() != llvm::dwarf::DW_TAG_member && member->getTag() != llvm::dwarf::DW_TAG_inheritance)
          continue;
        if (found == nullptr || found->getSizeInBits() == 0) found = member;
      }
    if (found == nullptr) {
      name += fmt::format("_{}", step.constant);
      type = nullptr;
      continue;
    }
    if (found->getTag() == llvm::dwarf::DW_TAG_member) name += "_" + without_trailing_underscores(found->getName());
    type = strip(found->getBaseType());
  }
  return name;
}

}  // namespace epiline::frontend
