#include "frontend/parameter_members.hpp"

#include <fmt/format.h>
#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfoMetadata.h>

#include "frontend/stream_arrays.hpp"
#include "frontend/top_function.hpp"

namespace epiline::frontend {

namespace {

/// A type without names, const and references in front of it.
const llvm::DIType* bare(const llvm::DIType* type) {
  while (const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type)) {
    const unsigned tag = derived->getTag();
    if (tag != llvm::dwarf::DW_TAG_typedef && tag != llvm::dwarf::DW_TAG_const_type &&
        tag != llvm::dwarf::DW_TAG_volatile_type && tag != llvm::dwarf::DW_TAG_reference_type)
      break;
    type = derived->getBaseType();
  }
  return type;
}

/// The T of hls::stream<T, DEPTH>; other types themselves.
const llvm::DIType* payload_of(const llvm::DIType* type) {
  const auto* composite = llvm::dyn_cast_or_null<llvm::DICompositeType>(type);
  if (composite != nullptr && composite->getTag() == llvm::dwarf::DW_TAG_array_type &&
      payload_of(bare(composite->getBaseType())) != bare(composite->getBaseType()))
    return payload_of(bare(composite->getBaseType()));  // an array of streams
  if (composite == nullptr || !composite->getName().starts_with("stream<")) return type;
  const llvm::DITemplateParameterArray parameters = composite->getTemplateParams();
  if (parameters.empty()) return nullptr;
  const auto* first = llvm::dyn_cast<llvm::DITemplateTypeParameter>(parameters[0]);
  return first == nullptr ? nullptr : bare(first->getType());
}

/// The type of an array's elements, whatever its dimensions; other types themselves.
const llvm::DIType* element_of(const llvm::DIType* type) {
  const auto* composite = llvm::dyn_cast_or_null<llvm::DICompositeType>(type);
  if (composite == nullptr || composite->getTag() != llvm::dwarf::DW_TAG_array_type) return type;
  return element_of(bare(composite->getBaseType()));
}

/// Appends the statements for `object`, an expression; false: cannot be told.
bool visit(const llvm::DIType* type, const std::string& object, unsigned depth, std::string& text) {
  type = bare(type);
  if (llvm::isa_and_nonnull<llvm::DIBasicType>(type)) {
    text += fmt::format("f({});", object);
    return true;
  }
  const auto* composite = llvm::dyn_cast_or_null<llvm::DICompositeType>(type);
  if (composite == nullptr || composite->isForwardDecl()) return false;
  if (composite->getTag() == llvm::dwarf::DW_TAG_enumeration_type || composite->getName().starts_with("ap_int_base<")) {
    text += fmt::format("f({});", object);
    return true;
  }
  if (composite->getTag() == llvm::dwarf::DW_TAG_array_type) {
    // An array of arrays is one type with several ranges.
    std::string element = object;
    for (const llvm::DINode* range : composite->getElements()) {
      if (!llvm::isa<llvm::DISubrange>(range)) return false;
      const std::string inner = fmt::format("epiline_element_{}", depth++);
      text += fmt::format("for (auto& {} : {}) {{", inner, element);
      element = inner;
    }
    const bool known = visit(composite->getBaseType(), element, depth, text);
    text.append(composite->getElements().size(), '}');
    return known;
  }
  if (composite->getTag() != llvm::dwarf::DW_TAG_structure_type &&
      composite->getTag() != llvm::dwarf::DW_TAG_class_type)
    return false;
  for (const llvm::DINode* element : composite->getElements()) {  // in the order of declaration, bases first
    const auto* member = llvm::dyn_cast<llvm::DIDerivedType>(element);
    if (member == nullptr || member->isStaticMember()) continue;
    if (member->getTag() == llvm::dwarf::DW_TAG_inheritance) {
      if (!visit(member->getBaseType(), object, depth, text)) return false;
    } else if (member->getTag() == llvm::dwarf::DW_TAG_member) {
      if (member->isBitField()) return false;
      if (member->getBaseType() != nullptr && bare(member->getBaseType())->getSizeInBits() == 0) continue;  // a tag
      const std::string name = member->getName().str();
      if (!visit(member->getBaseType(), name.empty() ? object : object + "." + name, depth, text)) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::optional<std::string>> parameter_members(llvm::Module& module, const std::string& top) {
  std::vector<std::optional<std::string>> result;
  const llvm::Function* function = find_top(module, top);
  if (function == nullptr) return result;
  const std::map<unsigned, unsigned> arrays = stream_arrays(module);
  const std::map<unsigned, unsigned> data = data_arrays(module);
  const auto add = [&](const llvm::DIType* type, unsigned times) {
    std::string text;
    const bool known = visit(payload_of(type), "v", 0, text);
    result.insert(result.end(), times, known ? std::optional(text) : std::nullopt);
  };
  const llvm::DITypeRefArray types = function->getSubprogram()->getType()->getTypeArray();
  for (unsigned i = 1; i < types.size(); ++i) {
    const auto array = arrays.find(i - 1);
    const llvm::DIType* type = bare(types[i]);
    if (array != arrays.end())
      if (const auto* pointer = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type);
          pointer != nullptr && pointer->getTag() == llvm::dwarf::DW_TAG_pointer_type)
        type = bare(pointer->getBaseType());
    if (const auto* pointer = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type);
        pointer != nullptr && pointer->getTag() == llvm::dwarf::DW_TAG_pointer_type) {
      if (data.count(i - 1) != 0) {
        add(element_of(bare(pointer->getBaseType())), 1);
        continue;
      }
      // To one value or, as the driver knows, to an array's.
      std::string text;
      const bool known = visit(pointer->getBaseType(), "element", 0, text);
      text = fmt::format("each(v, [&](auto& element) {{ {} }});", text);
      result.push_back(known ? std::optional(text) : std::nullopt);
      continue;
    }
    add(type, array == arrays.end() ? 1 : array->second);
  }
  if (returned_position(module) != 0) add(bare(types[0]), 1);
  return result;
}

}  // namespace epiline::frontend
