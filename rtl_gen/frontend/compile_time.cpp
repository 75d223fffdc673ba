#include "frontend/compile_time.hpp"

#include <llvm/Analysis/ConstantFolding.h>
#include <llvm/IR/IntrinsicInst.h>

#include <algorithm>

#include "frontend/host_mathematics.hpp"
#include "frontend/power_up.hpp"

namespace epiline::frontend {

namespace {

constexpr unsigned deepest_call = 1000;

constexpr std::size_t no_object = ~std::size_t{0};

}  // namespace

bool compile_time_run::run_function(const llvm::Function& function) {
  if (function.isDeclaration() || !function.arg_empty()) return false;
  try {
    frame values;
    value ignored;
    run_blocks(function.getEntryBlock(), nullptr, [](const llvm::BasicBlock&) { return true; }, values, ignored);
    return true;
  } catch (const unknown&) {
    return false;
  }
}

llvm::Constant* compile_time_run::result_of(const llvm::CallBase& called) {
  try {
    frame values;
    llvm::Constant* const result = call(called, values).number;
    const auto may_change = [](const llvm::Value* variable) {
      const auto* global = llvm::dyn_cast<llvm::GlobalVariable>(variable);
      return global == nullptr || !global->isConstant();
    };
    const std::vector<const llvm::Value*> read = read_variables();
    const bool depends = !written_variables().empty() || std::any_of(read.begin(), read.end(), may_change);
    return depends || !llvm::isa_and_nonnull<llvm::ConstantInt>(result) ? nullptr : result;
  } catch (const unknown&) {
    return nullptr;
  }
}

compile_time_run::edge compile_time_run::run_part(const llvm::BasicBlock& start, const llvm::BasicBlock& before,
                                                  llvm::function_ref<bool(const llvm::BasicBlock&)> is_part) {
  try {
    value ignored;
    return run_blocks(start, &before, is_part, values_, ignored);
  } catch (const unknown&) {
    return {};
  }
}

compile_time_run::edge compile_time_run::run_blocks(const llvm::BasicBlock& start, const llvm::BasicBlock* before,
                                                    llvm::function_ref<bool(const llvm::BasicBlock&)> is_part,
                                                    frame& values, value& returned) {
  const llvm::BasicBlock* block = &start;
  while (is_part(*block)) {
    enter(*block, before, values);
    if (const auto* end = llvm::dyn_cast<llvm::ReturnInst>(block->getTerminator())) {
      if (end->getReturnValue() != nullptr) returned = value_of(end->getReturnValue(), values);
      return {block, nullptr};
    }
    before = block;
    block = leave(*block, values);
  }
  return {before, block};
}

void compile_time_run::enter(const llvm::BasicBlock& block, const llvm::BasicBlock* before, frame& values) {
  // All of them look at what was there before any of them changes it.
  std::vector<std::pair<const llvm::Value*, value>> joined;
  for (const llvm::PHINode& join : block.phis())
    joined.emplace_back(&join, value_of(join.getIncomingValueForBlock(before), values));
  for (const auto& [join, chosen] : joined) values[join] = chosen;
  for (const llvm::Instruction& at : llvm::make_range(block.getFirstNonPHIIt(), block.getTerminator()->getIterator())) {
    if (++steps_ > most_steps_) throw unknown{};
    execute(at, values);
  }
}

const llvm::BasicBlock* compile_time_run::leave(const llvm::BasicBlock& block, frame& values) {
  if (++steps_ > most_steps_) throw unknown{};
  const llvm::Instruction& end = *block.getTerminator();
  if (const auto* branch = llvm::dyn_cast<llvm::BranchInst>(&end)) {
    if (branch->isUnconditional()) return branch->getSuccessor(0);
    const auto* condition = llvm::dyn_cast<llvm::ConstantInt>(number_of(branch->getCondition(), values));
    if (condition == nullptr) throw unknown{};
    return branch->getSuccessor(condition->isZero() ? 1 : 0);
  }
  if (const auto* choice = llvm::dyn_cast<llvm::SwitchInst>(&end)) {
    const auto* condition = llvm::dyn_cast<llvm::ConstantInt>(number_of(choice->getCondition(), values));
    if (condition == nullptr) throw unknown{};
    return choice->findCaseValue(condition)->getCaseSuccessor();
  }
  throw unknown{};
}

void compile_time_run::execute(const llvm::Instruction& at, frame& values) {
  if (const auto* slot = llvm::dyn_cast<llvm::AllocaInst>(&at)) {
    const auto size = slot->getAllocationSize(layout_);
    if (!size || size->isScalable()) throw unknown{};
    object fresh;
    fresh.bytes.resize(size->getFixedValue());
    fresh.known.resize(fresh.bytes.size());
    fresh.written.resize(fresh.bytes.size());
    objects_.push_back(std::move(fresh));
    values[&at] = {nullptr, objects_.size() - 1, 0};
    return;
  }
  if (const auto* load_at = llvm::dyn_cast<llvm::LoadInst>(&at)) {
    if (load_at->isVolatile()) throw unknown{};
    values[&at] = load(load_at->getType(), place_of(load_at->getPointerOperand(), values));
    return;
  }
  if (const auto* store_at = llvm::dyn_cast<llvm::StoreInst>(&at)) {
    if (store_at->isVolatile()) throw unknown{};
    const llvm::Value* const stored = store_at->getValueOperand();
    store(value_of(stored, values), stored->getType(), place_of(store_at->getPointerOperand(), values));
    return;
  }
  if (const auto* called = llvm::dyn_cast<llvm::CallBase>(&at)) {
    const value result = call(*called, values);
    if (!at.getType()->isVoidTy()) values[&at] = result;
    return;
  }
  if (const auto* element = llvm::dyn_cast<llvm::GEPOperator>(&at)) {
    values[&at] = place_of_element(*element, values);
    return;
  }
  if (const auto* selection = llvm::dyn_cast<llvm::SelectInst>(&at)) {
    const auto* condition = llvm::dyn_cast<llvm::ConstantInt>(number_of(selection->getCondition(), values));
    if (condition == nullptr) throw unknown{};
    values[&at] = value_of(condition->isZero() ? selection->getFalseValue() : selection->getTrueValue(), values);
    return;
  }
  if (at.getType()->isPtrOrPtrVectorTy()) throw unknown{};
  llvm::SmallVector<llvm::Constant*, 4> operands;
  for (const llvm::Value* operand : at.operands()) operands.push_back(number_of(operand, values));
  llvm::Constant* const folded = fold_constants(at, operands);
  if (folded == nullptr || llvm::isa<llvm::ConstantExpr>(folded)) throw unknown{};
  values[&at] = {folded};
}

compile_time_run::value compile_time_run::call(const llvm::CallBase& call, frame& values) {
  const llvm::Function* const callee = call.getCalledFunction();
  if (callee == nullptr) throw unknown{};
  if (callee->isIntrinsic()) return call_intrinsic(call, values);
  if (callee->getName().starts_with("__epiline_pragma_")) return {};
  if (callee->isDeclaration()) {
    llvm::SmallVector<llvm::Constant*, 2> arguments;
    for (const llvm::Value* argument : call.args()) arguments.push_back(number_of(argument, values));
    llvm::Constant* const result = call_host_mathematics(callee->getName(), call.getType(), arguments);
    if (result == nullptr) throw unknown{};
    return {result};
  }
  if (callee->isVarArg() || ++depth_ > deepest_call) throw unknown{};
  frame inner;
  for (const llvm::Argument& parameter : callee->args())
    inner[&parameter] = value_of(call.getArgOperand(parameter.getArgNo()), values);
  value returned;
  run_blocks(callee->getEntryBlock(), nullptr, [](const llvm::BasicBlock&) { return true; }, inner, returned);
  --depth_;
  return returned;
}

compile_time_run::value compile_time_run::call_intrinsic(const llvm::CallBase& call, frame& values) {
  switch (call.getIntrinsicID()) {
    case llvm::Intrinsic::dbg_declare:
    case llvm::Intrinsic::dbg_value:
    case llvm::Intrinsic::dbg_assign:
    case llvm::Intrinsic::dbg_label:
    case llvm::Intrinsic::lifetime_start:
    case llvm::Intrinsic::lifetime_end:
    case llvm::Intrinsic::assume:
    case llvm::Intrinsic::experimental_noalias_scope_decl:
    case llvm::Intrinsic::donothing:
      return {};
    case llvm::Intrinsic::invariant_start:
      if (const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(call.getArgOperand(1)))
        constant_.push_back(variable);
      return {llvm::UndefValue::get(call.getType()), no_object};
    case llvm::Intrinsic::memcpy:
    case llvm::Intrinsic::memcpy_inline:
    case llvm::Intrinsic::memmove: {
      const auto* size = llvm::dyn_cast<llvm::ConstantInt>(number_of(call.getArgOperand(2), values));
      if (size == nullptr) throw unknown{};
      copy_bytes(place_of(call.getArgOperand(0), values), place_of(call.getArgOperand(1), values),
                 size->getZExtValue());
      return {};
    }
    case llvm::Intrinsic::memset: {
      const auto* byte = llvm::dyn_cast<llvm::ConstantInt>(number_of(call.getArgOperand(1), values));
      const auto* size = llvm::dyn_cast<llvm::ConstantInt>(number_of(call.getArgOperand(2), values));
      if (byte == nullptr || size == nullptr) throw unknown{};
      const value place = place_of(call.getArgOperand(0), values);
      for (std::uint64_t i = 0; i < size->getZExtValue(); ++i)
        store_number(const_cast<llvm::ConstantInt*>(byte),
                     {nullptr, place.object, place.offset + static_cast<std::int64_t>(i)}, true);
      return {};
    }
    default:
      break;
  }
  llvm::SmallVector<llvm::Constant*, 4> arguments;
  for (const llvm::Value* argument : call.args()) arguments.push_back(number_of(argument, values));
  const llvm::Function& callee = *call.getCalledFunction();
  if (!llvm::canConstantFoldCallTo(&call, &callee)) throw unknown{};
  llvm::Constant* const result =
      llvm::ConstantFoldCall(&call, const_cast<llvm::Function*>(&callee), arguments, nullptr);
  if (result == nullptr || llvm::isa<llvm::ConstantExpr>(result)) throw unknown{};
  return {result};
}

void compile_time_run::copy_bytes(const value& to, const value& from, std::uint64_t size) {
  if (size == 0) return;
  object source = accessed(from, size);  // a copy of its own: the two may be one object
  for (std::uint64_t i = 0; i < size; ++i)
    objects_[from.object].is_read |= !source.written[static_cast<std::uint64_t>(from.offset) + i];
  object& target = accessed(to, size);
  const auto begin = static_cast<std::uint64_t>(from.offset);
  const auto place = static_cast<std::uint64_t>(to.offset);
  for (std::uint64_t i = 0; i < size; ++i) {
    target.bytes[place + i] = source.bytes[begin + i];
    target.known[place + i] = source.known[begin + i];
    target.written[place + i] = true;
    target.places.erase(place + i);
    if (const auto found = source.places.find(begin + i); found != source.places.end())
      target.places[place + i] = found->second;
  }
  target.is_written = true;
}

compile_time_run::value compile_time_run::value_of(const llvm::Value* of, const frame& values) {
  if (of->getType()->isPointerTy()) return place_of(of, values);
  if (const auto* constant = llvm::dyn_cast<llvm::Constant>(of)) return {const_cast<llvm::Constant*>(constant)};
  const auto found = values.find(of);
  if (found == values.end()) throw unknown{};
  return found->second;
}

llvm::Constant* compile_time_run::number_of(const llvm::Value* of, const frame& values) {
  if (of->getType()->isPtrOrPtrVectorTy()) throw unknown{};
  llvm::Constant* const number = value_of(of, values).number;
  if (number == nullptr || llvm::isa<llvm::UndefValue, llvm::ConstantExpr>(number)) throw unknown{};
  return number;
}

compile_time_run::value compile_time_run::place_of(const llvm::Value* of, const frame& values) {
  if (const auto found = values.find(of); found != values.end()) return found->second;
  if (llvm::isa<llvm::ConstantPointerNull>(of)) return {nullptr, no_object, 0};
  if (const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(of))
    return place_of_variable(*variable, variable->getValueType());
  if (const auto* slot = llvm::dyn_cast<llvm::AllocaInst>(of))
    return place_of_variable(*slot, slot->getAllocatedType());
  if (const auto* element = llvm::dyn_cast<llvm::GEPOperator>(of); element != nullptr && llvm::isa<llvm::Constant>(of))
    return place_of_element(*element, values);
  throw unknown{};
}

compile_time_run::value compile_time_run::place_of_element(const llvm::GEPOperator& element, const frame& values) {
  value place = place_of(element.getPointerOperand(), values);
  llvm::MapVector<llvm::Value*, llvm::APInt> variable;
  llvm::APInt constant(64, 0);
  if (!element.collectOffset(layout_, 64, variable, constant)) throw unknown{};
  place.offset += constant.getSExtValue();
  for (const auto& [index, scale] : variable) {
    const auto* number = llvm::dyn_cast<llvm::ConstantInt>(number_of(index, values));
    if (number == nullptr) throw unknown{};
    place.offset += number->getValue().sextOrTrunc(64).getSExtValue() * scale.getSExtValue();
  }
  return place;
}

compile_time_run::value compile_time_run::place_of_variable(const llvm::Value& variable, llvm::Type* type) {
  const auto [found, is_new] = variables_.try_emplace(&variable, objects_.size());
  const value place{nullptr, found->second, 0};
  if (!is_new) return place;
  object fresh;
  fresh.variable = &variable;
  if (const auto* slot = llvm::dyn_cast<llvm::AllocaInst>(&variable); slot != nullptr && slot->isArrayAllocation())
    throw unknown{};
  fresh.bytes.resize(layout_.getTypeAllocSize(type).getFixedValue());
  fresh.known.resize(fresh.bytes.size());
  fresh.written.resize(fresh.bytes.size());
  objects_.push_back(std::move(fresh));
  const auto* global = llvm::dyn_cast<llvm::GlobalVariable>(&variable);
  if (global == nullptr) return place;
  if (!global->hasInitializer() || global->isThreadLocal()) throw unknown{};
  const std::size_t number = place.object;
  store({const_cast<llvm::Constant*>(global->getInitializer())}, type, place, false);
  objects_[number].is_written = false;
  return place;
}

compile_time_run::object& compile_time_run::accessed(const value& place, std::uint64_t size) {
  if (place.object >= objects_.size()) throw unknown{};
  object& at = objects_[place.object];
  if (place.offset < 0 || static_cast<std::uint64_t>(place.offset) + size > at.bytes.size()) throw unknown{};
  return at;
}

compile_time_run::value compile_time_run::load(llvm::Type* type, const value& place) {
  if (!type->isPointerTy()) return {load_number(type, place)};
  object& at = accessed(place, layout_.getTypeStoreSize(type).getFixedValue());
  const auto found = at.places.find(static_cast<std::uint64_t>(place.offset));
  if (found == at.places.end()) throw unknown{};
  at.is_read = at.is_read || !at.written[static_cast<std::uint64_t>(place.offset)];
  return found->second;
}

llvm::Constant* compile_time_run::load_number(llvm::Type* type, const value& place) {
  const std::uint64_t size = layout_.getTypeStoreSize(type).getFixedValue();
  object& at = accessed(place, size);
  const auto offset = static_cast<std::uint64_t>(place.offset);
  for (std::uint64_t i = 0; i < size; ++i) at.is_read = at.is_read || !at.written[offset + i];
  llvm::Constant* const result = constant_at(at, offset, type);
  if (result == nullptr || llvm::isa<llvm::UndefValue>(result)) throw unknown{};
  return result;
}

void compile_time_run::store(const value& stored, llvm::Type* type, const value& place, bool counts) {
  if (type->isPointerTy() && stored.number == nullptr) {
    const std::uint64_t size = layout_.getTypeStoreSize(type).getFixedValue();
    object& at = accessed(place, size);
    const auto offset = static_cast<std::uint64_t>(place.offset);
    for (std::uint64_t i = 0; i < size; ++i) {
      at.known[offset + i] = false;
      at.written[offset + i] = counts;
      at.places.erase(offset + i);
    }
    at.places[offset] = stored;
    at.is_written = true;
    return;
  }
  if (stored.number == nullptr) throw unknown{};
  store_number(stored.number, place, counts);
}

void compile_time_run::store_number(llvm::Constant* stored, const value& place, bool counts) {
  llvm::Type* const type = stored->getType();
  if (const auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
    const llvm::StructLayout& layout = *layout_.getStructLayout(const_cast<llvm::StructType*>(structure));
    for (unsigned i = 0; i < structure->getNumElements(); ++i)
      store_number(stored->getAggregateElement(i),
                   {nullptr, place.object, place.offset + static_cast<std::int64_t>(layout.getElementOffset(i))},
                   counts);
    return;
  }
  if (const auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
    const auto size = static_cast<std::int64_t>(layout_.getTypeAllocSize(array->getElementType()).getFixedValue());
    for (std::uint64_t i = 0; i < array->getNumElements(); ++i)
      store_number(stored->getAggregateElement(static_cast<unsigned>(i)),
                   {nullptr, place.object, place.offset + static_cast<std::int64_t>(i) * size}, counts);
    return;
  }
  if (type->isPointerTy()) return store(place_of(stored, frame()), type, place, counts);
  const std::uint64_t size = layout_.getTypeStoreSize(type).getFixedValue();
  object& at = accessed(place, size);
  llvm::APInt bits(static_cast<unsigned>(size * 8), 0);
  const bool is_known = !llvm::isa<llvm::UndefValue>(stored);
  if (const auto* number = llvm::dyn_cast<llvm::ConstantInt>(stored)) {
    bits = number->getValue().zextOrTrunc(bits.getBitWidth());
  } else if (const auto* real = llvm::dyn_cast<llvm::ConstantFP>(stored)) {
    bits = real->getValueAPF().bitcastToAPInt().zextOrTrunc(bits.getBitWidth());
  } else if (is_known) {
    throw unknown{};
  }
  const auto offset = static_cast<std::uint64_t>(place.offset);
  for (std::uint64_t i = 0; i < size; ++i) {
    at.bytes[offset + i] = static_cast<std::uint8_t>(bits.extractBitsAsZExtValue(8, static_cast<unsigned>(i * 8)));
    at.known[offset + i] = is_known;
    at.written[offset + i] = counts;
    at.places.erase(offset + i);
  }
  at.is_written = true;
}

llvm::Constant* compile_time_run::constant_at(const object& from, std::uint64_t offset, llvm::Type* type) const {
  if (auto* structure = llvm::dyn_cast<llvm::StructType>(type)) {
    const llvm::StructLayout& layout = *layout_.getStructLayout(structure);
    llvm::SmallVector<llvm::Constant*> members;
    for (unsigned i = 0; i < structure->getNumElements(); ++i) {
      members.push_back(constant_at(from, offset + layout.getElementOffset(i), structure->getElementType(i)));
      if (members.back() == nullptr) return nullptr;
    }
    return llvm::ConstantStruct::get(structure, members);
  }
  if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type)) {
    const std::uint64_t size = layout_.getTypeAllocSize(array->getElementType()).getFixedValue();
    std::vector<llvm::Constant*> elements;
    for (std::uint64_t i = 0; i < array->getNumElements(); ++i) {
      elements.push_back(constant_at(from, offset + i * size, array->getElementType()));
      if (elements.back() == nullptr) return nullptr;
    }
    return llvm::ConstantArray::get(array, elements);
  }
  if (type->isPointerTy()) {
    const auto found = from.places.find(offset);
    if (found == from.places.end()) return llvm::UndefValue::get(type);
    const value& place = found->second;
    if (place.object == no_object) return llvm::ConstantPointerNull::get(llvm::cast<llvm::PointerType>(type));
    auto* variable = const_cast<llvm::GlobalVariable*>(
        llvm::dyn_cast_or_null<llvm::GlobalVariable>(objects_[place.object].variable));
    if (variable == nullptr) return nullptr;
    llvm::LLVMContext& context = type->getContext();
    return llvm::ConstantExpr::getGetElementPtr(llvm::Type::getInt8Ty(context), variable,
                                                llvm::ConstantInt::get(llvm::Type::getInt64Ty(context), place.offset));
  }
  if (!type->isIntegerTy() && !type->isFloatingPointTy()) return nullptr;
  const std::uint64_t size = layout_.getTypeStoreSize(type).getFixedValue();
  llvm::APInt bits(static_cast<unsigned>(size * 8), 0);
  for (std::uint64_t i = 0; i < size; ++i) {
    if (!from.known[offset + i]) return llvm::UndefValue::get(type);
    bits.insertBits(from.bytes[offset + i], static_cast<unsigned>(i * 8), 8);
  }
  bits = bits.zextOrTrunc(static_cast<unsigned>(layout_.getTypeSizeInBits(type).getFixedValue()));
  if (type->isIntegerTy()) return llvm::ConstantInt::get(type->getContext(), bits);
  return llvm::ConstantFP::get(type->getContext(), llvm::APFloat(type->getFltSemantics(), bits));
}

const compile_time_run::object* compile_time_run::find(const llvm::Value& variable) const {
  const auto found = variables_.find(&variable);
  return found == variables_.end() || found->second >= objects_.size() ? nullptr : &objects_[found->second];
}

llvm::Constant* compile_time_run::value_of(const llvm::Instruction& at) const {
  const auto found = values_.find(&at);
  if (found == values_.end() || found->second.number == nullptr || at.getType()->isPointerTy()) return nullptr;
  return llvm::isa<llvm::UndefValue>(found->second.number) ? nullptr : found->second.number;
}

std::vector<const llvm::Value*> compile_time_run::read_variables() const {
  std::vector<const llvm::Value*> result;
  for (const object& at : objects_)
    if (at.variable != nullptr && at.is_read) result.push_back(at.variable);
  return result;
}

std::vector<const llvm::Value*> compile_time_run::written_variables() const {
  std::vector<const llvm::Value*> result;
  for (const object& at : objects_)
    if (at.variable != nullptr && at.is_written) result.push_back(at.variable);
  return result;
}

llvm::Constant* compile_time_run::contents_of(const llvm::Value& variable, llvm::Type* type) const {
  const object* const at = find(variable);
  return at == nullptr ? nullptr : constant_at(*at, 0, type);
}

const std::vector<bool>& compile_time_run::written_bytes(const llvm::Value& variable) const {
  static const std::vector<bool> none;
  const object* const at = find(variable);
  return at == nullptr ? none : at->written;
}

}  // namespace epiline::frontend
