#include "frontend/variable_accesses.hpp"

#include <fmt/format.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/IntrinsicInst.h>

#include "frontend/calls.hpp"

namespace epiline::frontend {

namespace {

/// Follows one variable's address through the function and collects its scalar accesses.
class access_collector {
 public:
  access_collector(const variable& of, const llvm::DataLayout& layout) : variable_(of), layout_(layout) {}

  variable_accesses collect() {
    follow(variable_.base, {}, variable_.type);
    return std::move(found_);
  }

 private:
  void follow(llvm::Value* pointer, const path_steps& path, llvm::Type* type) {
    const std::vector<llvm::User*> users(pointer->users().begin(), pointer->users().end());
    for (llvm::User* user : users) {
      auto* instruction = llvm::cast<llvm::Instruction>(user);
      if (auto* element = llvm::dyn_cast<llvm::GetElementPtrInst>(instruction)) {
        path_steps longer = path;
        llvm::Type* reached = type;
        descend(*element, longer, reached);
        follow(element, longer, reached);
        found_.dead.push_back(element);
      } else if (llvm::isa<llvm::LoadInst>(instruction)) {
        add(instruction, path, type, instruction->getType());
      } else if (auto* store = llvm::dyn_cast<llvm::StoreInst>(instruction)) {
        if (store->getPointerOperand() != pointer || store->getValueOperand() == pointer)
          refuse(place_of(*store),
                 fmt::format(
                     "the address of '{}' is stored: pointers must be known at compile time: use the variable itself",
                     variable_.name));
        add(instruction, path, type, store->getValueOperand()->getType());
      } else if (auto* call = llvm::dyn_cast<llvm::CallInst>(instruction)) {
        follow_call(*call, path);
      } else if (llvm::isa<llvm::PHINode>(instruction) || llvm::isa<llvm::SelectInst>(instruction)) {
        refuse(place_of(*instruction), fmt::format("a pointer or reference to '{}' is chosen at run time: choose "
                                                   "between the values instead, or use an index",
                                                   variable_.name));
      } else {
        refuse(place_of(*instruction),
               fmt::format("the address of '{}' is compared or computed with: use array indices", variable_.name));
      }
    }
  }

  void follow_call(llvm::CallInst& call, const path_steps& path) {
    const llvm::Function* callee = call.getCalledFunction();
    if (auto* intrinsic = llvm::dyn_cast<llvm::IntrinsicInst>(&call);
        intrinsic != nullptr &&
        (intrinsic->isLifetimeStartOrEnd() || intrinsic->getIntrinsicID() == llvm::Intrinsic::invariant_start)) {
      found_.dead.push_back(&call);
    } else if (callee != nullptr && callee->getName().starts_with("__epiline_pragma_")) {
      found_.pragmas.emplace_back(path, &call);
      found_.dead.push_back(&call);
    } else {
      refuse(place_of(call),
             fmt::format("the address of '{}' is passed to '{}', which is not defined in this source", variable_.name,
                         callee != nullptr ? readable_name(*callee) : "a function pointer"));
    }
  }

  /// Extends the path by one getelementptr; makes `type` the type reached.
  void descend(llvm::GetElementPtrInst& element, path_steps& path, llvm::Type*& type) {
    llvm::Type* const source = element.getSourceElementType();
    auto index = element.idx_begin();
    if (source->isIntegerTy(8) && !type->isIntegerTy(8)) {
      llvm::APInt offset(64, 0);
      if (element.accumulateConstantOffset(layout_, offset)) {
        descend_bytes(element, offset.getSExtValue(), path, type);
        return;
      }
    }
    while (type != source && !path.empty() && path.back().container == source && is_at_first(path.back()) &&
           !is_first_of(type, source)) {
      type = path.back().container;  // a pointer to the first member stands for the whole
      path.pop_back();
    }
    // Clang passes a struct of up to 16 bytes as two integers, { i64, i64 }: the second one is a place in bytes, too.
    if (llvm::APInt offset(64, 0);
        type != source && !is_first_of(type, source) && element.accumulateConstantOffset(layout_, offset)) {
      descend_bytes(element, offset.getSExtValue(), path, type);
      return;
    }
    while (type != source) {
      if (!step_into_first(path, type))
        refuse(place_of(element),
               fmt::format("'{}' is accessed as another type than it has: no type punning", variable_.name));
    }
    llvm::Value* first = *index++;
    if (!is_zero(first)) {
      if (path.empty() || !path.back().is_array())
        refuse(place_of(element),
               fmt::format("pointer arithmetic on '{}', which is not an array element: use an array", variable_.name));
      add_index(element, path.back(), first);
    }
    for (; index != element.idx_end(); ++index) {
      path_step step{type, 0, nullptr};
      if (auto* constant = llvm::dyn_cast<llvm::ConstantInt>(*index))
        step.constant = constant->getSExtValue();
      else
        step.dynamic = widened(element, *index);
      type = step_type(step);
      path.push_back(step);
    }
  }

  void descend_bytes(llvm::GetElementPtrInst& element, std::int64_t offset, path_steps& path, llvm::Type*& type) {
    while (offset != 0) {
      if (auto* structure = llvm::dyn_cast<llvm::StructType>(type);
          structure != nullptr && offset > 0 && static_cast<std::uint64_t>(offset) < layout_.getTypeAllocSize(type)) {
        const llvm::StructLayout* fields = layout_.getStructLayout(structure);
        const unsigned field = fields->getElementContainingOffset(static_cast<std::uint64_t>(offset));
        path.push_back({type, field, nullptr});
        offset -= static_cast<std::int64_t>(fields->getElementOffset(field));
        type = structure->getElementType(field);
      } else if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
        const auto size = static_cast<std::int64_t>(layout_.getTypeAllocSize(array->getElementType()));
        path.push_back({type, offset / size, nullptr});
        offset %= size;
        type = array->getElementType();
      } else if (!path.empty() && path.back().is_array() &&
                 offset % static_cast<std::int64_t>(layout_.getTypeAllocSize(type)) == 0) {
        path.back().constant += offset / static_cast<std::int64_t>(layout_.getTypeAllocSize(type));
        offset = 0;
      } else {
        refuse(place_of(element), fmt::format("'{}' is accessed between its members: no type punning", variable_.name));
      }
    }
  }

  static bool is_at_first(const path_step& step) {
    const auto* structure = llvm::dyn_cast<llvm::StructType>(step.container);
    return step.dynamic == nullptr && step.constant == (structure == nullptr ? 0 : first_member(*structure));
  }

  static bool is_zero(llvm::Value* index) {
    auto* constant = llvm::dyn_cast<llvm::ConstantInt>(index);
    return constant != nullptr && constant->isZero();
  }

  /// Whether `inner` is found by descending from `type` into first members.
  static bool is_first_of(llvm::Type* type, llvm::Type* inner) {
    path_steps scratch;
    while (type != inner)
      if (!step_into_first(scratch, type)) return false;
    return true;
  }

  /// The first one that has a size: the others mark something.
  static std::int64_t first_member(const llvm::StructType& structure) {
    unsigned member = 0;
    while (member + 1 < structure.getNumElements() && structure.getElementType(member)->isEmptyTy()) ++member;
    return member;
  }

  static bool step_into_first(path_steps& path, llvm::Type*& type) {
    auto* structure = llvm::dyn_cast<llvm::StructType>(type);
    if (!llvm::isa<llvm::ArrayType>(type) && (structure == nullptr || structure->getNumElements() == 0)) return false;
    path.push_back({type, structure == nullptr ? 0 : first_member(*structure), nullptr});
    type = step_type(path.back());
    return true;
  }

  static llvm::Value* widened(llvm::Instruction& before, llvm::Value* index) {
    llvm::IRBuilder<> builder(&before);
    return builder.CreateSExtOrTrunc(index, builder.getInt64Ty());
  }

  static void add_index(llvm::Instruction& before, path_step& step, llvm::Value* index) {
    if (auto* constant = llvm::dyn_cast<llvm::ConstantInt>(index)) {
      step.constant += constant->getSExtValue();
      return;
    }
    llvm::Value* wide = widened(before, index);
    llvm::IRBuilder<> builder(&before);
    step.dynamic = step.dynamic == nullptr ? wide : builder.CreateAdd(step.dynamic, wide);
  }

  /// Small structs pass through calls as one wide integer: takes such an access apart into its members'.
  bool add_pieces(llvm::Instruction* instruction, path_steps path, llvm::Type* type, llvm::Type* accessed) {
    const std::uint64_t bytes = layout_.getTypeStoreSize(accessed);
    std::uint64_t begin = 0;  // in the smallest object around that holds all of it
    while (begin + bytes > layout_.getTypeAllocSize(type)) {
      if (path.empty() || path.back().dynamic != nullptr) return false;
      const path_step& last = path.back();
      const auto index = static_cast<std::uint64_t>(last.constant);
      begin += last.is_array() ? index * layout_.getTypeAllocSize(type)
                               : layout_.getStructLayout(llvm::cast<llvm::StructType>(last.container))
                                     ->getElementOffset(static_cast<unsigned>(index));
      type = last.container;
      path.pop_back();
    }
    std::vector<std::pair<std::uint64_t, path_steps>> pieces;
    if (!collect_pieces(type, 0, begin, begin + bytes, path, pieces)) return false;
    auto* store = llvm::dyn_cast<llvm::StoreInst>(instruction);
    llvm::IRBuilder<> builder(instruction);
    llvm::Value* const pointer = llvm::getLoadStorePointerOperand(instruction);
    llvm::Value* whole = llvm::ConstantInt::get(accessed, 0);
    for (const auto& [offset, piece] : pieces) {
      llvm::Type* const scalar = step_type(piece.back());
      if (store != nullptr) {
        llvm::Value* const bits = builder.CreateTrunc(builder.CreateLShr(store->getValueOperand(), offset * 8), scalar);
        found_.accesses.push_back({builder.CreateStore(bits, pointer), piece});
      } else {
        llvm::LoadInst* const bits = builder.CreateLoad(scalar, pointer);
        found_.accesses.push_back({bits, piece});
        whole = builder.CreateOr(whole, builder.CreateShl(builder.CreateZExt(bits, accessed), offset * 8));
      }
    }
    if (store == nullptr) instruction->replaceAllUsesWith(whole);
    instruction->eraseFromParent();
    return true;
  }

  /// The scalars of `type` (which lies at byte `offset`) in bytes [begin, end), with their distance from `begin`; false
  /// when one lies there in part only.
  bool collect_pieces(llvm::Type* type, std::uint64_t offset, std::uint64_t begin, std::uint64_t end, path_steps& path,
                      std::vector<std::pair<std::uint64_t, path_steps>>& pieces) const {
    if (offset >= end || offset + layout_.getTypeAllocSize(type) <= begin) return true;
    const auto descend_to = [&](std::uint64_t index, std::uint64_t distance) {
      path.push_back({type, static_cast<std::int64_t>(index), nullptr});
      const bool whole = collect_pieces(step_type(path.back()), offset + distance, begin, end, path, pieces);
      path.pop_back();
      return whole;
    };
    if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
      for (std::uint64_t i = 0; i < array->getNumElements(); ++i)
        if (!descend_to(i, i * layout_.getTypeAllocSize(array->getElementType()))) return false;
      return true;
    }
    if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
      for (unsigned i = 0; i < structure->getNumElements(); ++i)
        if (!descend_to(i, layout_.getStructLayout(structure)->getElementOffset(i))) return false;
      return true;
    }
    if (!type->isIntegerTy() || offset < begin || offset + layout_.getTypeStoreSize(type) > end) return false;
    pieces.emplace_back(offset - begin, path);
    return true;
  }

  void add(llvm::Instruction* instruction, path_steps path, llvm::Type* type, llvm::Type* accessed) {
    const path_steps whole_path = path;
    llvm::Type* const whole_type = type;
    while (!type->isSingleValueType())
      if (!step_into_first(path, type)) break;
    const bool narrower_load = llvm::isa<llvm::LoadInst>(instruction) && type->isIntegerTy() &&
                               accessed->isIntegerTy() && accessed->getIntegerBitWidth() < type->getIntegerBitWidth();
    if (type != accessed && !narrower_load) {
      if (accessed->isIntegerTy() && add_pieces(instruction, whole_path, whole_type, accessed)) return;
      if (accessed->isFloatingPointTy() || type->isFloatingPointTy())
        refuse(place_of(*instruction),
               fmt::format("floating point ('{}'): use ap_int/ap_uint (fixed point) instead", variable_.name));
      refuse(place_of(*instruction),
             fmt::format("'{}' is accessed as another type than it has: no unions, no type punning", variable_.name));
    }
    if (!type->isIntegerTy()) {
      if (type->isFloatingPointTy())
        refuse(place_of(*instruction),
               fmt::format("floating point ('{}'): use ap_int/ap_uint (fixed point) instead", variable_.name));
      refuse(place_of(*instruction),
             fmt::format("'{}' holds a pointer that is not known at compile time", variable_.name));
    }
    found_.accesses.push_back({instruction, std::move(path)});
  }

  const variable& variable_;
  const llvm::DataLayout& layout_;
  variable_accesses found_;
};

}  // namespace

variable_accesses collect_accesses(const variable& of, const llvm::DataLayout& layout) {
  return access_collector(of, layout).collect();
}

}  // namespace epiline::frontend
