#include "frontend/copies.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>

#include <algorithm>
#include <set>

#include "frontend/element_loop.hpp"
#include "frontend/payload.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

namespace {

constexpr std::size_t largest_copy = 8192;      // scalars moved in one clock
constexpr std::uint64_t longest_unrolled = 64;  // scalars of an array that becomes no memory for their sake

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

llvm::Constant* set_value(const llvm::MemSetInst& set, llvm::Type* type, const llvm::DataLayout& layout) {
  const auto* pattern = llvm::dyn_cast<llvm::ConstantInt>(set.getValue());
  if (pattern == nullptr || !type->isIntegerTy()) refuse(place_of(set), "memset with a run-time value: write a loop");
  const unsigned stored_bits = static_cast<unsigned>(layout.getTypeStoreSizeInBits(type));
  return llvm::ConstantInt::get(
      type, llvm::APInt::getSplat(stored_bits, pattern->getValue().trunc(8)).trunc(type->getIntegerBitWidth()));
}

/// How an object is used: whether an index known at run time reaches into it, and what is partitioned in it.
class object_uses {
 public:
  explicit object_uses(const llvm::Value* pointer, const llvm::DataLayout& layout)
      : layout_(layout), object_(llvm::getUnderlyingObject(pointer, 0)) {
    if (llvm::isa<llvm::AllocaInst, llvm::GlobalVariable>(object_)) follow(*object_);
  }

  bool indexed_at_run_time = false;

  /// Whether ARRAY_PARTITION speaks of dimension `dimension`, counted from 1, of an array `offset` bytes from the
  /// start.
  [[nodiscard]] bool is_partitioned(std::uint64_t offset, unsigned dimension) const {
    return std::any_of(partitions_.begin(), partitions_.end(), [&](const auto& one) {
      return one.first <= offset && (one.second == 0 || one.second == dimension);
    });
  }

 private:
  void follow(const llvm::Value& pointer) {
    if (!seen_.insert(&pointer).second) return;
    for (const llvm::User* user : pointer.users()) {
      if (const auto* element = llvm::dyn_cast<llvm::GEPOperator>(user))
        indexed_at_run_time = indexed_at_run_time || !element->hasAllConstantIndices();
      const auto* call = llvm::dyn_cast<llvm::CallInst>(user);
      if (call != nullptr && call->getCalledFunction() != nullptr &&
          call->getCalledFunction()->getName() == "__epiline_pragma_partition")
        note_partition(*call, pointer);
      if (llvm::isa<llvm::GEPOperator, llvm::PHINode, llvm::SelectInst, llvm::ConstantExpr>(user)) follow(*user);
    }
  }

  void note_partition(const llvm::CallInst& call, const llvm::Value& pointer) {
    llvm::APInt offset(64, 0);
    if (pointer.stripAndAccumulateConstantOffsets(layout_, offset, true) != object_) return;
    const auto* dimension = llvm::dyn_cast<llvm::ConstantInt>(call.getArgOperand(1));
    partitions_.insert({offset.getZExtValue(), dimension == nullptr ? 0 : dimension->getZExtValue()});
  }

  const llvm::DataLayout& layout_;
  const llvm::Value* object_;
  std::set<const llvm::Value*> seen_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> partitions_;
};

/// Copies or sets a large object by loops: one word a clock is what a memory takes.
class copy_loops {
 public:
  copy_loops(llvm::MemIntrinsic& copy, const object_uses& uses, const llvm::DataLayout& layout)
      : copy_(copy), uses_(uses), layout_(layout), builder_(&copy) {}

  void run(llvm::Type* type) {
    auto* transfer = llvm::dyn_cast<llvm::MemTransferInst>(&copy_);
    llvm::APInt offset(64, 0);
    static_cast<void>(copy_.getRawDest()->stripAndAccumulateConstantOffsets(layout_, offset, true));
    emit(type, copy_.getRawDest(), transfer == nullptr ? nullptr : transfer->getRawSource(), offset.getZExtValue(), 1);
  }

 private:
  void emit(llvm::Type* type, llvm::Value* to, llvm::Value* from, std::uint64_t offset, unsigned dimension) {
    if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
      for (unsigned i = 0; i < structure->getNumElements(); ++i)
        emit(structure->getElementType(i), element(type, to, builder_.getInt32(i)),
             element(type, from, builder_.getInt32(i)),
             offset + layout_.getStructLayout(structure)->getElementOffset(i), 1);
    } else if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
      emit_array(*array, to, from, offset, dimension);
    } else if (from != nullptr) {
      builder_.CreateStore(builder_.CreateLoad(type, from), to);
    } else {
      builder_.CreateStore(set_value(llvm::cast<llvm::MemSetInst>(copy_), type, layout_), to);
    }
  }

  void emit_array(llvm::ArrayType& array, llvm::Value* to, llvm::Value* from, std::uint64_t offset,
                  unsigned dimension) {
    llvm::Type* const type = array.getElementType();
    const std::uint64_t count = array.getNumElements();
    if (count <= 2 || uses_.is_partitioned(offset, dimension)) {
      for (std::uint64_t i = 0; i < count; ++i)
        emit(type, element(&array, to, builder_.getInt64(i)), element(&array, from, builder_.getInt64(i)), offset,
             dimension + 1);
      return;
    }
    for_each_index(builder_, count, [&](llvm::Value* index) {
      emit(type, element(&array, to, index), element(&array, from, index), offset, dimension + 1);
    });
  }

  llvm::Value* element(llvm::Type* type, llvm::Value* base, llvm::Value* index) {
    if (base == nullptr) return nullptr;
    return builder_.CreateInBoundsGEP(type, base, {builder_.getInt32(0), index});
  }

  llvm::MemIntrinsic& copy_;
  const object_uses& uses_;
  const llvm::DataLayout& layout_;
  llvm::IRBuilder<> builder_;
};

/// Whether a copy of so much, of or into memories, is to be a loop. The two must not overlap: a loop writes before it
/// has read all.
bool is_for_loops(llvm::MemIntrinsic& copy, llvm::Type* type, const object_uses& uses, const llvm::DataLayout& layout) {
  if (sum_of_scalars(type, [](llvm::Type*) { return 1; }) <= longest_unrolled) return false;
  const auto* transfer = llvm::dyn_cast<llvm::MemTransferInst>(&copy);
  if (transfer == nullptr) return uses.indexed_at_run_time;
  const bool may_overlap =
      llvm::isa<llvm::MemMoveInst>(copy) &&
      llvm::getUnderlyingObject(copy.getRawDest(), 0) == llvm::getUnderlyingObject(transfer->getRawSource(), 0);
  return !may_overlap &&
         (uses.indexed_at_run_time || object_uses(transfer->getRawSource(), layout).indexed_at_run_time);
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
  if (const object_uses uses(copy.getRawDest(), layout); is_for_loops(copy, type, uses, layout)) {
    if (otherwise == unknown_types::kept) return false;  // what is indexed at run time shows when loops are unrolled
    copy_loops(copy, uses, layout).run(type);
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
    values.push_back(set_value(llvm::cast<llvm::MemSetInst>(copy), types[i], layout));
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
