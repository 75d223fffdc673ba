#include "frontend/aggregates.hpp"

#include <llvm/Analysis/ConstantFolding.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/ReplaceConstant.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>

#include <algorithm>
#include <map>
#include <set>

#include "frontend/checks.hpp"
#include "frontend/payload.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

constexpr std::uint64_t largest_multiplexer = 4096;  // registers that one index chooses from

/// One index on the way from a variable to a scalar: constant + dynamic, in a struct or an array.
struct path_step {
  llvm::Type* container = nullptr;
  std::int64_t constant = 0;
  llvm::Value* dynamic = nullptr;  // i64, or null

  [[nodiscard]] bool is_array() const { return llvm::isa<llvm::ArrayType>(container); }
  [[nodiscard]] std::uint64_t size() const { return llvm::cast<llvm::ArrayType>(container)->getNumElements(); }
};
using path_steps = std::vector<path_step>;

llvm::Type* step_type(const path_step& step) {
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(step.container)) return array->getElementType();
  return llvm::cast<llvm::StructType>(step.container)->getElementType(static_cast<unsigned>(step.constant));
}

/// A variable: a local of the process, a static, or a constant table.
struct variable {
  llvm::Value* base = nullptr;
  llvm::Type* type = nullptr;
  llvm::Constant* initial = nullptr;  // statics and tables
  bool is_constant = false;
  std::string name;
  const llvm::DIType* debug_type = nullptr;
  source_place place;
};

struct scalar_access {
  llvm::Instruction* instruction;  // load or store
  path_steps path;
};

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

/// The members and constant indices of a path as the source names them: "_lines_3".
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

/// Follows one variable's address through the function and collects its scalar accesses.
class access_collector {
 public:
  access_collector(variable& of, const llvm::DataLayout& layout) : variable_(of), layout_(layout) {}

  void collect() { follow(variable_.base, {}, variable_.type); }

  std::vector<scalar_access> accesses;
  std::vector<std::pair<path_steps, llvm::CallInst*>> pragmas;
  std::vector<llvm::Instruction*> dead;  // users before their operands

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
        dead.push_back(element);
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
      dead.push_back(&call);
    } else if (callee != nullptr && callee->getName().starts_with("__epiline_pragma_")) {
      pragmas.emplace_back(path, &call);
      dead.push_back(&call);
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
    while (type != source && !path.empty() && path.back().container == source && path.back().constant == 0 &&
           path.back().dynamic == nullptr && !is_first_of(type, source)) {
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

  static bool step_into_first(path_steps& path, llvm::Type*& type) {
    auto* structure = llvm::dyn_cast<llvm::StructType>(type);
    if (!llvm::isa<llvm::ArrayType>(type) && (structure == nullptr || structure->getNumElements() == 0)) return false;
    path.push_back({type, 0, nullptr});
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
        accesses.push_back({builder.CreateStore(bits, pointer), piece});
      } else {
        llvm::LoadInst* const bits = builder.CreateLoad(scalar, pointer);
        accesses.push_back({bits, piece});
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
    accesses.push_back({instruction, std::move(path)});
  }

  variable& variable_;
  const llvm::DataLayout& layout_;
};

/// The path without array indices: what the decisions about dimensions are keyed by.
std::string shape_of(const path_steps& path, std::size_t count) {
  std::string shape;
  for (std::size_t i = 0; i < count; ++i)
    shape += path[i].is_array() ? std::string("[]") : fmt::format(".{}", path[i].constant);
  return shape;
}

class splitter {
 public:
  explicit splitter(lowered_process& result)
      : result_(result),
        function_(*result.function),
        layout_(function_.getParent()->getDataLayout()),
        dominators_(function_),
        loops_(dominators_) {}

  void split(variable& of) {
    access_collector collected(of, layout_);
    collected.collect();
    variable_ = &of;
    dynamic_.clear();
    partitioned_.clear();
    distances_.clear();
    unreset_.clear();
    scalars_.clear();
    objects_.clear();
    for (const auto& [path, call] : collected.pragmas) apply_pragma(path, *call);
    for (const scalar_access& access : collected.accesses)
      for (std::size_t i = 0; i < access.path.size(); ++i)
        if (access.path[i].dynamic != nullptr) dynamic_.insert(shape_of(access.path, i));
    for (scalar_access& access : collected.accesses) rewrite(access);
    for (llvm::Instruction* instruction : collected.dead) instruction->eraseFromParent();
    if (auto* slot = llvm::dyn_cast<llvm::AllocaInst>(of.base)) slot->eraseFromParent();
  }

  std::vector<llvm::AllocaInst*> made;

 private:
  enum class role : std::uint8_t { constant, multiplexed, address };

  void apply_pragma(const path_steps& path, llvm::CallInst& call) {
    const llvm::StringRef pragma = call.getCalledFunction()->getName();
    const bool is_dependence = pragma == "__epiline_pragma_dependence";
    // A pointer to an array may have decayed to one to its first element; the pragma speaks of the whole.
    std::size_t length = path.size();
    while (length > 0 && path[length - 1].is_array() && path[length - 1].constant == 0 &&
           path[length - 1].dynamic == nullptr)
      --length;
    const std::string shape = shape_of(path, length);
    if (pragma == "__epiline_pragma_reset") {
      if (variable_->initial == nullptr)
        refuse(place_of(call),
               fmt::format("#pragma HLS RESET off: '{}' is not static, so nothing resets it: remove the pragma",
                           variable_->name));
      unreset_.push_back(shape);
      return;
    }
    const int value = pragma_number(call, 1, is_dependence ? 1 : 0);
    if (is_dependence)
      distances_.emplace_back(shape, static_cast<unsigned>(value));
    else
      partition(path, length, shape, static_cast<unsigned>(value), call);
  }

  [[nodiscard]] bool is_unreset(const path_steps& path) const {
    const std::string shape = shape_of(path, path.size());
    return std::any_of(unreset_.begin(), unreset_.end(),
                       [&](const std::string& prefix) { return llvm::StringRef(shape).starts_with(prefix); });
  }

  void partition(const path_steps& path, std::size_t length, const std::string& shape, unsigned dimension,
                 const llvm::CallInst& call) {
    unsigned dimensions = 0;
    llvm::Type* type = length == 0 ? variable_->type : step_type(path[length - 1]);
    for (; llvm::isa<llvm::ArrayType>(type); ++dimensions) type = type->getArrayElementType();
    const bool is_object = llvm::isa<llvm::StructType>(type);  // whose arrays are meant too
    if (dimensions == 0 && !is_object)
      refuse(place_of(call), fmt::format("#pragma HLS ARRAY_PARTITION: '{}' is not an array", variable_->name));
    if (dimension > dimensions && !is_object)
      refuse(place_of(call), fmt::format("#pragma HLS ARRAY_PARTITION dim={}: '{}' has {} dimension{}", dimension,
                                         variable_->name, dimensions, dimensions == 1 ? "" : "s"));
    partitioned_.emplace_back(shape, dimension);
  }

  [[nodiscard]] bool is_partitioned(const path_steps& path, std::size_t position) const {
    const std::string shape = shape_of(path, position);
    for (const auto& [prefix, dimension] : partitioned_) {
      if (!llvm::StringRef(shape).starts_with(prefix)) continue;
      if (dimension == 0) return true;
      unsigned count = 1;
      for (std::size_t i = 0; i < position; ++i)
        if (path[i].is_array() && shape_of(path, i).size() >= prefix.size()) ++count;
      if (count == dimension) return true;
    }
    return false;
  }

  [[nodiscard]] unsigned promised_distance(const path_steps& path) const {
    const std::string shape = shape_of(path, path.size());
    unsigned distance = 0;
    for (const auto& [prefix, value] : distances_)
      if (llvm::StringRef(shape).starts_with(prefix)) distance = std::max(distance, value);
    return distance;
  }

  /// What each step's index is for.
  [[nodiscard]] std::vector<role> roles_of(const path_steps& path) const {
    std::vector<role> roles(path.size(), role::constant);
    std::uint64_t words = 1;
    bool any_large = false;
    for (std::size_t i = 0; i < path.size(); ++i)
      if (path[i].is_array() && dynamic_.count(shape_of(path, i)) != 0) {
        words *= path[i].size();
        any_large = any_large || (path[i].size() > largest_register_array && !is_partitioned(path, i));
      }
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (!path[i].is_array() || dynamic_.count(shape_of(path, i)) == 0) continue;
      const bool multiplexed = !variable_->is_constant && (is_partitioned(path, i) || words <= largest_register_array ||
                                                           (any_large && path[i].size() <= largest_register_array));
      roles[i] = multiplexed ? role::multiplexed : role::address;
      if (multiplexed && path[i].size() > largest_multiplexer)
        refuse(variable_->place,
               fmt::format("'{}' has {} elements, reached by an index known at run time: too many for "
                           "registers: leave out ARRAY_PARTITION, and it becomes a memory",
                           variable_->name, path[i].size()));
    }
    return roles;
  }

  void rewrite(scalar_access& access) {
    const std::vector<role> roles = roles_of(access.path);
    check_range(access);
    auto* store = llvm::dyn_cast<llvm::StoreInst>(access.instruction);
    llvm::IRBuilder<> builder(access.instruction);
    if (store != nullptr) {
      if (variable_->is_constant)
        refuse(place_of(*store), fmt::format("a store into the constant '{}'", variable_->name));
      write(builder, access.path, roles, 0, store->getValueOperand(), builder.getTrue());
    } else {
      llvm::Value* value = read(builder, access.path, roles, 0);
      value = builder.CreateTrunc(value, access.instruction->getType());
      access.instruction->replaceAllUsesWith(value);
    }
    access.instruction->eraseFromParent();
  }

  /// Unrolling leaves indices past the end behind conditions that never hold. Refuses those without a condition.
  void check_range(const scalar_access& access) const {
    const auto wrong = std::find_if(access.path.begin(), access.path.end(), out_of_range);
    if (wrong == access.path.end()) return;
    const llvm::BasicBlock* block = access.instruction->getParent();
    const llvm::Loop* loop = loops_.getLoopFor(block);
    if (loop == nullptr || loop->getLoopLatch() == nullptr || !dominators_.dominates(block, loop->getLoopLatch()))
      return;
    refuse(place_of(*access.instruction),
           fmt::format("index {} of '{}', which has {} elements there: indices run from 0 to {}", wrong->constant,
                       variable_->name, wrong->size(), wrong->size() - 1));
  }

  static bool out_of_range(const path_step& step) {
    return step.is_array() && step.dynamic == nullptr &&
           (step.constant < 0 || static_cast<std::uint64_t>(step.constant) >= step.size());
  }

  llvm::Value* index_value(llvm::IRBuilder<>& builder, const path_step& step) {
    llvm::Value* const constant = builder.getInt64(static_cast<std::uint64_t>(step.constant));
    if (step.dynamic == nullptr) return constant;
    return step.constant == 0 ? step.dynamic : builder.CreateAdd(step.dynamic, constant);
  }

  llvm::Value* read(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<role>& roles, std::size_t from) {
    for (std::size_t i = from; i < path.size(); ++i) {
      if (out_of_range(path[i])) return llvm::UndefValue::get(scalar_type(path));
      if (roles[i] != role::multiplexed || path[i].dynamic == nullptr) continue;
      const path_step original = path[i];
      llvm::Value* const index = index_value(builder, original);
      std::vector<llvm::Value*> values;
      for (std::uint64_t k = 0; k < original.size(); ++k) {
        path[i].constant = static_cast<std::int64_t>(k);
        path[i].dynamic = nullptr;
        values.push_back(read(builder, path, roles, i + 1));
      }
      path[i] = original;
      return multiplexer(builder, index, std::move(values));
    }
    return read_scalar(builder, path, roles);
  }

  /// A balanced tree, one level an index bit.
  static llvm::Value* multiplexer(llvm::IRBuilder<>& builder, llvm::Value* index, std::vector<llvm::Value*> values) {
    for (unsigned bit = 0; values.size() > 1; ++bit) {
      llvm::Value* const odd = builder.CreateTrunc(builder.CreateLShr(index, bit), builder.getInt1Ty());
      std::vector<llvm::Value*> half;
      for (std::size_t i = 0; i < values.size(); i += 2)
        half.push_back(i + 1 < values.size() ? builder.CreateSelect(odd, values[i + 1], values[i]) : values[i]);
      values = std::move(half);
    }
    return values.front();
  }

  void write(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<role>& roles, std::size_t from,
             llvm::Value* value, llvm::Value* enable) {
    for (std::size_t i = from; i < path.size(); ++i) {
      if (out_of_range(path[i])) return;
      if (roles[i] != role::multiplexed || path[i].dynamic == nullptr) continue;
      const path_step original = path[i];
      llvm::Value* const index = index_value(builder, original);
      for (std::uint64_t k = 0; k < original.size(); ++k) {
        path[i].constant = static_cast<std::int64_t>(k);
        path[i].dynamic = nullptr;
        llvm::Value* const here = builder.CreateICmpEQ(index, builder.getInt64(k));
        write(builder, path, roles, i + 1, value, builder.CreateAnd(enable, here));
      }
      path[i] = original;
      return;
    }
    write_scalar(builder, path, roles, value, enable);
  }

  static llvm::Type* scalar_type(const path_steps& path) { return step_type(path.back()); }

  /// One scalar or memory: the path with its constant and multiplexed indices.
  std::string key_of(const path_steps& path, const std::vector<role>& roles) const {
    std::string key;
    for (std::size_t i = 0; i < path.size(); ++i)
      key += roles[i] == role::address ? std::string("/*") : fmt::format("/{}", path[i].constant);
    return key;
  }

  static bool has_address(const std::vector<role>& roles) {
    return std::find(roles.begin(), roles.end(), role::address) != roles.end();
  }

  llvm::Value* read_scalar(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<role>& roles) {
    llvm::Type* const type = path.empty() ? variable_->type : scalar_type(path);
    if (has_address(roles)) {
      const unsigned object = object_for(path, roles);
      const access kind = variable_->is_constant ? access::table : access::memory_read;
      return make_access(builder, kind, object, type->getIntegerBitWidth(), {address(builder, path, roles)});
    }
    if (variable_->is_constant) return initial_at(path);
    return builder.CreateLoad(type, scalar_for(path, roles, type));
  }

  void write_scalar(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<role>& roles, llvm::Value* value,
                    llvm::Value* enable) {
    if (has_address(roles)) {
      make_access(builder, access::memory_write, object_for(path, roles), value->getType()->getIntegerBitWidth(),
                  {address(builder, path, roles), value, enable});
      return;
    }
    llvm::AllocaInst* const slot = scalar_for(path, roles, value->getType());
    auto* always = llvm::dyn_cast<llvm::ConstantInt>(enable);
    if (always == nullptr || !always->isOne())
      value = builder.CreateSelect(enable, value, builder.CreateLoad(value->getType(), slot));
    builder.CreateStore(value, slot);
  }

  llvm::Value* address(llvm::IRBuilder<>& builder, const path_steps& path, const std::vector<role>& roles) {
    llvm::Value* sum = builder.getInt64(0);
    for (std::size_t i = 0; i < path.size(); ++i)
      if (roles[i] == role::address)
        sum =
            builder.CreateAdd(builder.CreateMul(sum, builder.getInt64(path[i].size())), index_value(builder, path[i]));
    return sum;
  }

  llvm::Constant* initial_at(const path_steps& path) const {
    llvm::Constant* value = variable_->initial;
    for (const path_step& step : path)
      value = value == nullptr ? nullptr : value->getAggregateElement(static_cast<unsigned>(step.constant));
    return value != nullptr ? value : llvm::UndefValue::get(scalar_type(path));
  }

  llvm::AllocaInst* scalar_for(const path_steps& path, const std::vector<role>& roles, llvm::Type* type) {
    llvm::AllocaInst*& slot = scalars_[key_of(path, roles)];
    if (slot == nullptr) {
      llvm::BasicBlock& entry = function_.getEntryBlock();
      llvm::IRBuilder<> builder(&entry, entry.begin());
      slot = builder.CreateAlloca(
          type, nullptr, variable_->name + path_name(*variable_, path, std::vector<bool>(path.size(), false), layout_));
      made.push_back(slot);
      if (variable_->initial != nullptr) {
        builder.SetInsertPoint(entry.getTerminator());
        llvm::Constant* const initial = path.empty() ? variable_->initial : initial_at(path);
        const bool resets = !is_unreset(path) || !llvm::isa<llvm::ConstantInt>(initial);
        builder.CreateStore(resets ? static_cast<llvm::Value*>(initial) : make_power_up(builder, initial), slot);
      }
    }
    return slot;
  }

  unsigned object_for(const path_steps& path, const std::vector<role>& roles) {
    const auto [found, is_new] = objects_.try_emplace(key_of(path, roles), 0);
    if (!is_new) return found->second;
    std::vector<bool> is_address;
    std::uint64_t words = 1;
    for (std::size_t i = 0; i < path.size(); ++i) {
      is_address.push_back(roles[i] == role::address);
      if (is_address.back()) words *= path[i].size();
    }
    const std::string name = variable_->name + path_name(*variable_, path, is_address, layout_);
    const unsigned width = scalar_type(path)->getIntegerBitWidth();
    if (words > (1u << 24))
      refuse(variable_->place,
             fmt::format("'{}' has {} words: too large for memory on the chip", variable_->name, words));
    std::vector<llvm::APInt> initial;
    if (variable_->initial != nullptr) {
      path_steps at = path;
      fill_initial(at, roles, 0, width, initial);
    }
    if (variable_->is_constant) {
      found->second = static_cast<unsigned>(result_.tables.size());
      result_.tables.push_back({name, width, std::move(initial), false, {}});
      result_.table_places.push_back(variable_->place);
    } else {
      found->second = static_cast<unsigned>(result_.memories.size());
      dataflow::memory made_memory;
      made_memory.name = name;
      made_memory.words = static_cast<unsigned>(words);
      made_memory.width = width;
      made_memory.initial = std::move(initial);
      if (const unsigned distance = promised_distance(path); distance > 1) {
        made_memory.distance = distance;
        made_memory.distance_promised = true;
      }
      result_.memories.push_back(std::move(made_memory));
      result_.memory_places.push_back(variable_->place);
    }
    return found->second;
  }

  void fill_initial(path_steps& path, const std::vector<role>& roles, std::size_t from, unsigned width,
                    std::vector<llvm::APInt>& words) const {
    for (std::size_t i = from; i < path.size(); ++i) {
      if (roles[i] != role::address) continue;
      const path_step original = path[i];
      for (std::uint64_t k = 0; k < original.size(); ++k) {
        path[i].constant = static_cast<std::int64_t>(k);
        path[i].dynamic = nullptr;
        fill_initial(path, roles, i + 1, width, words);
      }
      path[i] = original;
      return;
    }
    const auto* value = llvm::dyn_cast<llvm::ConstantInt>(initial_at(path));
    words.push_back(value != nullptr ? value->getValue() : llvm::APInt(width, 0));
  }

  lowered_process& result_;
  llvm::Function& function_;
  const llvm::DataLayout& layout_;
  llvm::DominatorTree dominators_;
  llvm::LoopInfo loops_;
  variable* variable_ = nullptr;
  std::set<std::string> dynamic_;
  std::vector<std::pair<std::string, unsigned>> partitioned_;
  std::vector<std::pair<std::string, unsigned>> distances_;
  std::vector<std::string> unreset_;
  std::map<std::string, llvm::AllocaInst*> scalars_;
  std::map<std::string, unsigned> objects_;
};

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

void split_aggregates(lowered_process& result) {
  llvm::Function& function = *result.function;
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
  splitter all(result);
  for (variable& of : variables) all.split(of);
  llvm::DominatorTree dominators(function);
  llvm::PromoteMemToReg(all.made, dominators);
}

}  // namespace epiline::frontend
