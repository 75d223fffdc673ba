#include "frontend/stream_types.hpp"

#include <fmt/format.h>
#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Module.h>

#include <algorithm>
#include <optional>

#include "frontend/calls.hpp"

namespace epiline::frontend {

namespace {

/// Appends the streams that a type at `offset` holds. `array`, if there is one, is where the array around it begins.
void find_streams_in(const llvm::DIType* type, std::uint64_t offset, std::optional<std::uint64_t> array,
                     const std::string& name, std::vector<placed_stream>& found) {
  while (const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type)) {
    if (derived->getTag() != llvm::dwarf::DW_TAG_typedef && derived->getTag() != llvm::dwarf::DW_TAG_const_type) return;
    type = derived->getBaseType();
  }
  const auto* composite = llvm::dyn_cast_or_null<llvm::DICompositeType>(type);
  if (composite == nullptr) return;
  if (composite->getTag() == llvm::dwarf::DW_TAG_array_type) {
    const std::uint64_t size = composite->getBaseType()->getSizeInBits() / 8;
    for (std::uint64_t i = 0; size != 0 && i < composite->getSizeInBits() / 8 / size; ++i) {
      find_streams_in(composite->getBaseType(), offset + i * size, array.value_or(offset),
                      fmt::format("{}_{}", name, i), found);
      if (found.empty()) return;  // the other elements hold none either
    }
  } else if (stream_type(composite, false) != nullptr) {
    found.push_back({offset, array.value_or(offset), composite, name});
  } else {
    for (const llvm::DINode* element : composite->getElements()) {
      const auto* member = llvm::dyn_cast<llvm::DIDerivedType>(element);
      if (member == nullptr || member->isStaticMember()) continue;
      const bool is_base = member->getTag() == llvm::dwarf::DW_TAG_inheritance;
      if (is_base || member->getTag() == llvm::dwarf::DW_TAG_member)
        find_streams_in(member->getBaseType(), offset + member->getOffsetInBits() / 8, {},
                        is_base ? name : name + "_" + member->getName().str(), found);
    }
  }
}

/// Whether a parameter's type is, refers to or holds streams.
bool brings_streams(const llvm::DIType* type) {
  if (stream_type(type, true) != nullptr) return true;
  const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type);
  const bool refers = derived != nullptr && (derived->getTag() == llvm::dwarf::DW_TAG_reference_type ||
                                             derived->getTag() == llvm::dwarf::DW_TAG_pointer_type);
  return refers && !streams_in(derived->getBaseType()).empty();
}

/// Whether a value is a static variable of streams.
bool is_static_stream(const llvm::Value& value) {
  const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(value.stripInBoundsOffsets());
  if (variable == nullptr || variable->isDeclaration()) return false;
  llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> described;
  variable->getDebugInfo(described);
  return !described.empty() && !streams_in(described.front()->getVariable()->getType()).empty();
}

}  // namespace

const llvm::DICompositeType* stream_type(const llvm::DIType* type, bool behind_references) {
  while (type != nullptr) {
    if (const auto* derived = llvm::dyn_cast<llvm::DIDerivedType>(type)) {
      const auto tag = derived->getTag();
      const bool same = tag == llvm::dwarf::DW_TAG_typedef || tag == llvm::dwarf::DW_TAG_const_type;
      if (!same && !behind_references) return nullptr;
      type = derived->getBaseType();
      continue;
    }
    const auto* composite = llvm::dyn_cast<llvm::DICompositeType>(type);
    if (composite == nullptr) return nullptr;
    if (composite->getTag() == llvm::dwarf::DW_TAG_array_type) {
      type = composite->getBaseType();
      continue;
    }
    const auto* space = llvm::dyn_cast_or_null<llvm::DINamespace>(composite->getScope());
    const bool is_stream = space != nullptr && space->getName() == "hls" && composite->getName().starts_with("stream<");
    return is_stream ? composite : nullptr;
  }
  return nullptr;
}

std::vector<placed_stream> streams_in(const llvm::DIType* type, const std::string& name) {
  std::vector<placed_stream> found;
  find_streams_in(type, 0, {}, name, found);
  return found;
}

unsigned depth_of(const llvm::DICompositeType& type) {
  llvm::StringRef last = type.getName().rsplit(',').second.trim();
  unsigned depth = 0;
  const bool given = !last.consumeInteger(10, depth) && last.trim() == ">" && depth != 0;
  return given ? std::min(depth, most_depth) : 0;
}

bool takes_streams(const llvm::Function& function) {
  const llvm::DISubprogram* program = function.getSubprogram();
  if (program == nullptr || program->getName().starts_with("__epiline_") ||  // of a pragma
      stream_type(llvm::dyn_cast_or_null<llvm::DIType>(program->getScope()), false) != nullptr)
    return false;
  const llvm::DITypeRefArray types = program->getType()->getTypeArray();
  for (unsigned i = 1; i < types.size(); ++i)
    if (types[i] != nullptr && !types[i]->isArtificial() && brings_streams(types[i])) return true;
  return false;
}

bool joins_streams(const llvm::Function& root) {
  for (const llvm::Function* function : reached_from(root))
    for (const llvm::Instruction& instruction : llvm::instructions(*function)) {
      for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange()))
        if (!record.getVariable()->isParameter() && !streams_in(record.getVariable()->getType()).empty()) return true;
      for (const llvm::Use& operand : instruction.operands())
        if (operand->getType()->isPointerTy() && is_static_stream(*operand)) return true;
    }
  return false;
}

}  // namespace epiline::frontend
