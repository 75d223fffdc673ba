#include "frontend/payload.hpp"

#include <fmt/format.h>
#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfo.h>

#include <algorithm>
#include <array>

namespace epiline::frontend {

namespace {

constexpr std::array<const char*, 8> axis_signals = {"tdata", "tdata", "tkeep", "tstrb",
                                                     "tuser", "tlast", "tid",   "tdest"};

/// The number k of a tag member [0 x [k x iN]]; 0 when it is none.
unsigned tag_of(llvm::Type* type, unsigned element_bits) {
  auto* outer = llvm::dyn_cast<llvm::ArrayType>(type);
  if (outer == nullptr || outer->getNumElements() != 0) return 0;
  auto* inner = llvm::dyn_cast<llvm::ArrayType>(outer->getElementType());
  if (inner == nullptr || !inner->getElementType()->isIntegerTy(element_bits)) return 0;
  return static_cast<unsigned>(inner->getNumElements());
}

/// The alignment a type has in C++, in bytes: ap types have none (see hls/types), whatever LLVM would give them.
std::uint64_t source_alignment(llvm::Type* type, const llvm::DataLayout& layout) {
  unsigned width = 0;
  bool is_signed = false;
  if (is_arbitrary_precision(type, width, is_signed)) return 1;
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type))
    return array->getNumElements() == 0 ? 1 : source_alignment(array->getElementType(), layout);
  auto* structure = llvm::dyn_cast<llvm::StructType>(type);
  if (structure == nullptr) return layout.getABITypeAlign(type).value();
  std::uint64_t alignment = 1;
  for (llvm::Type* member : structure->elements()) alignment = std::max(alignment, source_alignment(member, layout));
  return alignment;
}

/// Whether element `index`, `bytes` bytes, stands where a gap of a struct with ap types would be, and fills it.
bool fills_a_gap(const llvm::StructType& structure, unsigned index, std::uint64_t bytes,
                 const llvm::DataLayout& layout) {
  if (!structure.isPacked() || bytes > 15) return false;
  const llvm::StructLayout& offsets = *layout.getStructLayout(const_cast<llvm::StructType*>(&structure));
  const std::uint64_t begin = offsets.getElementOffset(index);
  std::uint64_t alignment = 1;
  if (index + 1 < structure.getNumElements()) {
    alignment = source_alignment(structure.getElementType(index + 1), layout);
  } else {
    alignment = source_alignment(const_cast<llvm::StructType*>(&structure), layout);
  }
  return begin % alignment != 0 && (begin + bytes) % alignment == 0 && bytes < alignment;
}

bool is_padding_byte(const llvm::StructType& structure, unsigned index, const llvm::Module& module);

struct collector {
  const source_place& place;
  const llvm::DataLayout& layout;
  const llvm::Module& module;  // whose debug information tells a padding byte from a member
  std::vector<leaf> leaves;
  std::vector<unsigned> path;
  unsigned axis_field = 0;

  void visit(llvm::Type* type) {
    unsigned width = 0;
    bool is_signed = false;
    if (is_arbitrary_precision(type, width, is_signed)) {
      path.push_back(0);
      add(llvm::cast<llvm::IntegerType>(llvm::cast<llvm::StructType>(type)->getElementType(0)), width, is_signed);
      path.pop_back();
    } else if (auto* integer = llvm::dyn_cast<llvm::IntegerType>(type)) {
      add(integer, integer->getBitWidth(), false);
    } else if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
      for (unsigned i = 0; i < array->getNumElements(); ++i) visit_member(array->getElementType(), i);
    } else if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
      if (structure->hasName() && structure->getName().starts_with("union."))
        refuse(place, "a union in a stream or parameter: which member is meant is not known: use a struct");
      const unsigned outside = axis_field;
      for (unsigned i = 0; i < structure->getNumElements(); ++i) {
        llvm::Type* const member = structure->getElementType(i);
        if (const unsigned tag = tag_of(member, 32); tag != 0)
          axis_field = tag;
        else if (!is_padding(*structure, i, layout) && !is_padding_byte(*structure, i, module))
          visit_member(member, i);
      }
      axis_field = outside;
    } else if (type->isFloatingPointTy()) {
      refuse(place, "floating point in a stream or parameter: use ap_int/ap_uint (fixed point) instead");
    } else {
      refuse(place,
             "a stream or parameter of pointers or other types that are not built of integers: pass ap_int, "
             "ap_uint, C integers or structs of them");
    }
  }

  void visit_member(llvm::Type* type, unsigned index) {
    path.push_back(index);
    visit(type);
    path.pop_back();
  }

  void add(llvm::IntegerType* storage, unsigned width, bool is_signed) {
    leaves.push_back({path, storage, width, is_signed, axis_field});
  }
};

/// The last part of a type's name: of "struct.space::record.12" and "record<3>", "record".
llvm::StringRef short_name(llvm::StringRef name) {
  name = name.take_until([](char c) { return c == '<'; });
  if (const std::size_t number = name.find_last_not_of("0123456789");
      number != llvm::StringRef::npos && number + 1 < name.size() && name[number] == '.')
    name = name.take_front(number);
  if (const std::size_t scope = name.rfind("::"); scope != llvm::StringRef::npos) return name.drop_front(scope + 2);
  return name.drop_front(name.rfind('.') + 1);  // npos + 1 = 0
}

/// The name of the member that begins at a bit of a C++ struct; "" when none does.
llvm::StringRef member_at(const llvm::DICompositeType& type, std::uint64_t bit) {
  for (const llvm::DINode* element : type.getElements())
    if (const auto* member = llvm::dyn_cast<llvm::DIDerivedType>(element);
        member != nullptr && member->getTag() == llvm::dwarf::DW_TAG_member && !member->isStaticMember() &&
        member->getOffsetInBits() == bit && member->getSizeInBits() != 0)
      return member->getName();
  return "";
}

/// The C++ types that a struct may stand for: of its name and size.
std::vector<const llvm::DICompositeType*> source_types(llvm::StructType& structure, const llvm::Module& module) {
  std::vector<const llvm::DICompositeType*> found;
  llvm::DebugInfoFinder finder;
  finder.processModule(module);
  for (const llvm::DIType* described : finder.types()) {
    const auto* composite = llvm::dyn_cast<llvm::DICompositeType>(described);
    if (composite != nullptr && !composite->isForwardDecl() &&
        short_name(composite->getName()) == short_name(structure.getName()) &&
        composite->getSizeInBits() == module.getDataLayout().getTypeAllocSizeInBits(&structure))
      found.push_back(composite);
  }
  return found;
}

/// clang writes a gap of one byte as an i8, as it does a `char` or a `bool`: only the debug information tells them
/// apart.
bool is_padding_byte(const llvm::StructType& structure, unsigned index, const llvm::Module& module) {
  const llvm::DataLayout& layout = module.getDataLayout();
  if (!structure.getElementType(index)->isIntegerTy(8) || !structure.hasName() ||
      !fills_a_gap(structure, index, 1, layout))
    return false;
  auto* type = const_cast<llvm::StructType*>(&structure);
  const std::uint64_t bit = 8 * layout.getStructLayout(type)->getElementOffset(index);
  const std::vector<const llvm::DICompositeType*> described = source_types(*type, module);
  return !described.empty() && std::none_of(described.begin(), described.end(), [&](const llvm::DICompositeType* one) {
    return !member_at(*one, bit).empty();
  });
}

llvm::Value* address_of(llvm::IRBuilderBase& builder, llvm::Value* pointer, llvm::Type* type, const leaf& member) {
  std::vector<llvm::Value*> indices{builder.getInt32(0)};
  for (const unsigned index : member.path) indices.push_back(builder.getInt32(index));
  return builder.CreateInBoundsGEP(type, pointer, indices);
}

}  // namespace

std::uint64_t sum_of_scalars(llvm::Type* type, llvm::function_ref<std::uint64_t(llvm::Type*)> of) {
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type))
    return array->getNumElements() * sum_of_scalars(array->getElementType(), of);
  if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
    std::uint64_t sum = 0;
    for (llvm::Type* member : structure->elements()) sum += sum_of_scalars(member, of);
    return sum;
  }
  return of(type);
}

bool is_padding(const llvm::StructType& structure, unsigned index, const llvm::DataLayout& layout) {
  auto* bytes = llvm::dyn_cast<llvm::ArrayType>(structure.getElementType(index));
  return bytes != nullptr && bytes->getElementType()->isIntegerTy(8) &&
         fills_a_gap(structure, index, bytes->getNumElements(), layout);
}

bool is_arbitrary_precision(llvm::Type* type, unsigned& width, bool& is_signed) {
  auto* structure = llvm::dyn_cast<llvm::StructType>(type);
  if (structure == nullptr || structure->getNumElements() < 2 || !structure->getElementType(0)->isIntegerTy())
    return false;
  for (unsigned i = 1; i < structure->getNumElements(); ++i) {
    if (const unsigned w = tag_of(structure->getElementType(i), 8); w != 0) {
      width = w;
      is_signed = false;
      return true;
    }
    if (const unsigned w = tag_of(structure->getElementType(i), 16); w != 0) {
      width = w;
      is_signed = true;
      return true;
    }
  }
  return false;
}

void refuse_members_like_padding(llvm::Type* type, const llvm::Module& module, const source_place& place) {
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type))
    return refuse_members_like_padding(array->getElementType(), module, place);
  auto* structure = llvm::dyn_cast<llvm::StructType>(type);
  if (structure == nullptr) return;
  const llvm::DataLayout& layout = module.getDataLayout();
  for (unsigned i = 0; i < structure->getNumElements(); ++i) {
    refuse_members_like_padding(structure->getElementType(i), module, place);
    if (!structure->hasName() || !is_padding(*structure, i, layout)) continue;
    for (const llvm::DICompositeType* composite : source_types(*structure, module)) {
      const llvm::StringRef member = member_at(*composite, 8 * layout.getStructLayout(structure)->getElementOffset(i));
      if (!member.empty())
        refuse(place, fmt::format("the bytes '{}' of struct '{}' stand where padding would be and cannot be told from "
                                  "it: make them ap_uint<8>",
                                  member.str(), composite->getName().str()));
    }
  }
}

std::vector<leaf> leaves_of(llvm::Type* type, const llvm::Module& module, const source_place& place) {
  collector all{place, module.getDataLayout(), module, {}, {}, 0};
  all.visit(type);
  // Several beats, or a beat and more, are numbers like others: a port has each signal of a beat once.
  const auto comes_before = [](const leaf& a, const leaf& b) { return a.axis_field < b.axis_field; };
  if (!std::is_sorted(all.leaves.begin(), all.leaves.end(), comes_before))
    for (leaf& member : all.leaves) member.axis_field = 0;
  return all.leaves;
}

std::vector<dataflow::field> fields_of(const std::vector<leaf>& leaves) {
  std::vector<dataflow::field> fields;
  unsigned offset = 0;
  for (const leaf& member : leaves) {
    const std::string signal = axis_signals.at(member.axis_field);
    if (fields.empty() || fields.back().signal != signal) {
      fields.push_back({signal.substr(1), signal, 0, offset, member.is_signed});
    } else {
      fields.back().is_signed = false;  // several numbers have no common sign
    }
    fields.back().width += member.width;
    offset += member.width;
  }
  return fields;
}

unsigned width_of(const std::vector<leaf>& leaves) {
  unsigned width = 0;
  for (const leaf& member : leaves) width += member.width;
  return width;
}

void unpack_token(llvm::IRBuilderBase& builder, llvm::Value* token, llvm::Value* pointer, llvm::Type* type,
                  const std::vector<leaf>& leaves) {
  unsigned offset = 0;
  for (const leaf& member : leaves) {
    llvm::Value* bits = offset == 0 ? token : builder.CreateLShr(token, offset);
    bits = builder.CreateTrunc(bits, builder.getIntNTy(member.width));
    bits = member.is_signed ? builder.CreateSExt(bits, member.storage) : builder.CreateZExt(bits, member.storage);
    builder.CreateStore(bits, address_of(builder, pointer, type, member));
    offset += member.width;
  }
}

llvm::Value* pack_token(llvm::IRBuilderBase& builder, llvm::Value* pointer, llvm::Type* type,
                        const std::vector<leaf>& leaves) {
  llvm::Type* const token_type = builder.getIntNTy(width_of(leaves));
  llvm::Value* token = llvm::ConstantInt::get(token_type, 0);
  unsigned offset = 0;
  for (const leaf& member : leaves) {
    llvm::Value* bits = builder.CreateLoad(member.storage, address_of(builder, pointer, type, member));
    bits = builder.CreateZExt(builder.CreateTrunc(bits, builder.getIntNTy(member.width)), token_type);
    if (offset != 0) bits = builder.CreateShl(bits, offset);
    token = offset == 0 ? bits : builder.CreateOr(token, bits);
    offset += member.width;
  }
  return token;
}

}  // namespace epiline::frontend
