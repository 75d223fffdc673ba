#include "frontend/copies.hpp"

#include <fmt/format.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>

#include "frontend/payload.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

constexpr std::size_t largest_copy = 8192;  // scalars moved in one clock

/// Where the last member of a struct ends that is not padding: assignments copy that much.
std::uint64_t end_of_members(llvm::StructType& structure, const llvm::DataLayout& layout) {
  unsigned count = structure.getNumElements();
  while (count > 0 && is_padding(structure, count - 1, layout)) --count;
  if (count == 0) return 0;
  return layout.getStructLayout(&structure)->getElementOffset(count - 1) +
         layout.getTypeStoreSize(structure.getElementType(count - 1));
}

/// The first type of `bytes` bytes found by descending into first members, or null.
llvm::Type* descend_to_size(llvm::Type* type, std::uint64_t bytes, const llvm::DataLayout& layout) {
  while (type->isSized() && layout.getTypeAllocSize(type) > bytes) {
    if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
      // A run of several elements of an array counts as an array itself.
      const std::uint64_t element = layout.getTypeAllocSize(array->getElementType());
      if (element != 0 && element < bytes && bytes % element == 0)
        return llvm::ArrayType::get(array->getElementType(), bytes / element);
      type = array->getElementType();
    } else if (auto* structure = llvm::dyn_cast<llvm::StructType>(type);
               structure != nullptr && structure->getNumElements() > 0) {
      // A struct without a name holds the registers a value returns in: the members are those of the other side.
      if (!structure->isLiteral() && end_of_members(*structure, layout) == bytes) return type;
      type = structure->getElementType(0);
    } else {
      return nullptr;
    }
  }
  return type->isSized() && layout.getTypeAllocSize(type) == bytes ? type : nullptr;
}

llvm::Type* pointed_type(llvm::Value* pointer, std::uint64_t bytes, const llvm::DataLayout& layout,
                         unsigned depth = 8) {
  if (auto* slot = llvm::dyn_cast<llvm::AllocaInst>(pointer))
    return descend_to_size(slot->getAllocatedType(), bytes, layout);
  if (auto* global = llvm::dyn_cast<llvm::GlobalVariable>(pointer))
    return descend_to_size(global->getValueType(), bytes, layout);
  if (auto* element = llvm::dyn_cast<llvm::GEPOperator>(pointer)) {
    if (llvm::Type* found = descend_to_size(element->getResultElementType(), bytes, layout)) return found;
    // &array[i] used as the start of the array's rest.
    if (element->hasAllConstantIndices() || element->getNumIndices() == 1)
      return pointed_type(element->getPointerOperand(), bytes, layout, depth);
  }
  // One of several objects: they have the same type. A loop of choices ends the search.
  if (depth == 0) return nullptr;
  if (auto* phi = llvm::dyn_cast<llvm::PHINode>(pointer)) {
    for (llvm::Value* incoming : phi->incoming_values())
      if (llvm::Type* found = pointed_type(incoming, bytes, layout, depth - 1)) return found;
  } else if (auto* choice = llvm::dyn_cast<llvm::SelectInst>(pointer)) {
    if (llvm::Type* found = pointed_type(choice->getTrueValue(), bytes, layout, depth - 1)) return found;
    return pointed_type(choice->getFalseValue(), bytes, layout, depth - 1);
  }
  return nullptr;
}

void collect_paths(llvm::Type* type, std::vector<unsigned>& path, std::vector<std::vector<unsigned>>& paths,
                   std::vector<llvm::Type*>& types) {
  if (paths.size() > largest_copy) return;
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
    for (unsigned i = 0; i < array->getNumElements(); ++i) {
      path.push_back(i);
      collect_paths(array->getElementType(), path, paths, types);
      path.pop_back();
    }
  } else if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
    for (unsigned i = 0; i < structure->getNumElements(); ++i) {
      path.push_back(i);
      collect_paths(structure->getElementType(i), path, paths, types);
      path.pop_back();
    }
  } else {
    paths.push_back(path);
    types.push_back(type);
  }
}

llvm::Value* element_address(llvm::IRBuilderBase& builder, llvm::Value* base, llvm::Type* type,
                             const std::vector<unsigned>& path) {
  if (path.empty()) return base;
  std::vector<llvm::Value*> indices{builder.getInt32(0)};
  for (const unsigned index : path) indices.push_back(builder.getInt32(index));
  return builder.CreateInBoundsGEP(type, base, indices);
}

/// Returns whether the copy is replaced.
bool expand(llvm::MemIntrinsic& copy, const llvm::DataLayout& layout, unknown_types otherwise) {
  auto* length = llvm::dyn_cast<llvm::ConstantInt>(copy.getLength());
  if (length == nullptr && otherwise == unknown_types::kept) return false;  // another refusal may tell more
  if (length == nullptr) refuse(place_of(copy), "copy of a run-time number of bytes: write a loop over the elements");
  const std::uint64_t bytes = length->getZExtValue();
  auto* transfer = llvm::dyn_cast<llvm::MemTransferInst>(&copy);
  llvm::Type* type = bytes == 0 ? nullptr : pointed_type(copy.getRawDest(), bytes, layout);
  if (type == nullptr && transfer != nullptr && bytes != 0)
    type = pointed_type(transfer->getRawSource(), bytes, layout);
  if (type == nullptr) {
    if (bytes != 0 && otherwise == unknown_types::kept) return false;
    if (bytes != 0)
      refuse(place_of(copy),
             fmt::format("copy of {} bytes of unknown type: assign the members or elements one by one", bytes));
    return true;
  }
  std::vector<std::vector<unsigned>> paths;
  std::vector<llvm::Type*> types;
  std::vector<unsigned> path;
  collect_paths(type, path, paths, types);
  if (paths.size() > largest_copy)
    refuse(
        place_of(copy),
        "a whole array is cleared or copied at once: write a loop over its elements (a memory takes one word a clock)");
  llvm::IRBuilder<> builder(&copy);
  std::vector<llvm::Value*> values;  // read all before the first write: memmove's meaning
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (transfer != nullptr) {
      values.push_back(
          builder.CreateLoad(types[i], element_address(builder, transfer->getRawSource(), type, paths[i])));
      continue;
    }
    auto* pattern = llvm::dyn_cast<llvm::ConstantInt>(llvm::cast<llvm::MemSetInst>(copy).getValue());
    if (pattern == nullptr || !types[i]->isIntegerTy())
      refuse(place_of(copy), "memset with a run-time value: write a loop");
    const unsigned stored_bits = static_cast<unsigned>(layout.getTypeStoreSizeInBits(types[i]));
    values.push_back(builder.getInt(
        llvm::APInt::getSplat(stored_bits, pattern->getValue().trunc(8)).trunc(types[i]->getIntegerBitWidth())));
  }
  for (std::size_t i = 0; i < paths.size(); ++i)
    builder.CreateStore(values[i], element_address(builder, copy.getRawDest(), type, paths[i]));
  return true;
}

}  // namespace

void expand_copies(llvm::Function& function, unknown_types otherwise) {
  const llvm::DataLayout& layout = function.getParent()->getDataLayout();
  std::vector<llvm::MemIntrinsic*> copies;
  for (llvm::Instruction& instruction : llvm::instructions(function))
    if (auto* copy = llvm::dyn_cast<llvm::MemIntrinsic>(&instruction)) copies.push_back(copy);
  for (llvm::MemIntrinsic* copy : copies)
    if (expand(*copy, layout, otherwise)) copy->eraseFromParent();
}

void split_whole_structs(llvm::Function& function) {
  const llvm::DataLayout& layout = function.getParent()->getDataLayout();
  std::vector<llvm::Instruction*> whole;
  for (llvm::Instruction& instruction : llvm::instructions(function))
    if ((llvm::isa<llvm::LoadInst>(instruction) && instruction.getType()->isStructTy()) ||
        (llvm::isa<llvm::StoreInst>(instruction) &&
         llvm::cast<llvm::StoreInst>(instruction).getValueOperand()->getType()->isStructTy()))
      whole.push_back(&instruction);
  for (llvm::Instruction* instruction : whole) {
    auto* store = llvm::dyn_cast<llvm::StoreInst>(instruction);
    auto* type =
        llvm::cast<llvm::StructType>(store != nullptr ? store->getValueOperand()->getType() : instruction->getType());
    llvm::Value* const pointer = llvm::getLoadStorePointerOperand(instruction);
    llvm::IRBuilder<> builder(instruction);
    llvm::Value* value = llvm::PoisonValue::get(type);
    for (unsigned i = 0; i < type->getNumElements(); ++i) {
      // By bytes, since the object has another type than the registers it travels in.
      const std::uint64_t offset = layout.getStructLayout(type)->getElementOffset(i);
      llvm::Value* const member =
          offset == 0 ? pointer : builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), pointer, offset);
      if (store != nullptr)
        builder.CreateStore(builder.CreateExtractValue(store->getValueOperand(), i), member);
      else
        value = builder.CreateInsertValue(value, builder.CreateLoad(type->getElementType(i), member), i);
    }
    if (store == nullptr) instruction->replaceAllUsesWith(value);
    instruction->eraseFromParent();
  }
}

}  // namespace epiline::frontend
