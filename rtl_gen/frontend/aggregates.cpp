#include "frontend/aggregates.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/Dominators.h>

#include <algorithm>
#include <map>

#include "frontend/array_forms.hpp"
#include "frontend/promote.hpp"
#include "frontend/variable_accesses.hpp"
#include "frontend/variables.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

/// What the variables of a process have in common when they are split.
struct splitting {
  explicit splitting(lowered_process& process) : result(process), dominators(*process.function), loops(dominators) {}

  lowered_process& result;
  llvm::DominatorTree dominators;
  llvm::LoopInfo loops;
  std::vector<llvm::AllocaInst*> scalars;  // made of the variables
};

/// Splits one variable: its accesses become those of scalars, memories and tables.
class splitter {
 public:
  splitter(splitting& shared, const variable& of)
      : shared_(shared),
        result_(shared.result),
        function_(*shared.result.function),
        layout_(function_.getParent()->getDataLayout()),
        variable_(of),
        found_(collect_accesses(of, layout_)),
        forms_(of, found_) {}

  void split() {
    for (scalar_access& access : found_.accesses) rewrite(access);
    for (llvm::Instruction* instruction : found_.dead) instruction->eraseFromParent();
    if (auto* slot = llvm::dyn_cast<llvm::AllocaInst>(variable_.base)) slot->eraseFromParent();
  }

 private:
  void rewrite(scalar_access& access) {
    const std::vector<index_role> roles = forms_.roles_of(access.path);
    check_range(access);
    auto* store = llvm::dyn_cast<llvm::StoreInst>(access.instruction);
    llvm::IRBuilder<> builder(access.instruction);
    if (store != nullptr) {
      if (variable_.is_constant)
        refuse(place_of(*store), fmt::format("a store into the constant '{}'", variable_.name));
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
    const llvm::Loop* loop = shared_.loops.getLoopFor(block);
    if (loop == nullptr || loop->getLoopLatch() == nullptr ||
        !shared_.dominators.dominates(block, loop->getLoopLatch()))
      return;
    refuse(place_of(*access.instruction),
           fmt::format("index {} of '{}', which has {} elements there: indices run from 0 to {}", wrong->constant,
                       variable_.name, wrong->size(), wrong->size() - 1));
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

  llvm::Value* read(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<index_role>& roles,
                    std::size_t from) {
    for (std::size_t i = from; i < path.size(); ++i) {
      if (out_of_range(path[i])) return llvm::UndefValue::get(scalar_type(path));
      if (roles[i] != index_role::multiplexed || path[i].dynamic == nullptr) continue;
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

  void write(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<index_role>& roles, std::size_t from,
             llvm::Value* value, llvm::Value* enable) {
    for (std::size_t i = from; i < path.size(); ++i) {
      if (out_of_range(path[i])) return;
      if (roles[i] != index_role::multiplexed || path[i].dynamic == nullptr) continue;
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
  std::string key_of(const path_steps& path, const std::vector<index_role>& roles) const {
    std::string key;
    for (std::size_t i = 0; i < path.size(); ++i)
      key += roles[i] == index_role::address ? std::string("/*") : fmt::format("/{}", path[i].constant);
    return key;
  }

  static bool has_address(const std::vector<index_role>& roles) {
    return std::find(roles.begin(), roles.end(), index_role::address) != roles.end();
  }

  llvm::Value* read_scalar(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<index_role>& roles) {
    llvm::Type* const type = path.empty() ? variable_.type : scalar_type(path);
    if (has_address(roles)) {
      const unsigned object = object_for(path, roles);
      const access kind = variable_.is_constant ? access::table : access::memory_read;
      return make_access(builder, kind, object, type->getIntegerBitWidth(), {address(builder, path, roles)});
    }
    if (variable_.is_constant) return initial_at(path);
    return builder.CreateLoad(type, scalar_for(path, roles, type));
  }

  void write_scalar(llvm::IRBuilder<>& builder, path_steps& path, const std::vector<index_role>& roles,
                    llvm::Value* value, llvm::Value* enable) {
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

  llvm::Value* address(llvm::IRBuilder<>& builder, const path_steps& path, const std::vector<index_role>& roles) {
    llvm::Value* sum = builder.getInt64(0);
    for (std::size_t i = 0; i < path.size(); ++i)
      if (roles[i] == index_role::address)
        sum =
            builder.CreateAdd(builder.CreateMul(sum, builder.getInt64(path[i].size())), index_value(builder, path[i]));
    return sum;
  }

  llvm::Constant* initial_at(const path_steps& path) const {
    llvm::Constant* value = variable_.initial;
    for (const path_step& step : path)
      value = value == nullptr ? nullptr : value->getAggregateElement(static_cast<unsigned>(step.constant));
    return value != nullptr ? value : llvm::UndefValue::get(scalar_type(path));
  }

  llvm::AllocaInst* scalar_for(const path_steps& path, const std::vector<index_role>& roles, llvm::Type* type) {
    llvm::AllocaInst*& slot = scalars_[key_of(path, roles)];
    if (slot == nullptr) {
      llvm::BasicBlock& entry = function_.getEntryBlock();
      llvm::IRBuilder<> builder(&entry, entry.begin());
      slot = builder.CreateAlloca(
          type, nullptr, variable_.name + path_name(variable_, path, std::vector<bool>(path.size(), false), layout_));
      shared_.scalars.push_back(slot);
      if (variable_.initial != nullptr) {
        builder.SetInsertPoint(entry.getTerminator());
        llvm::Constant* const initial = path.empty() ? variable_.initial : initial_at(path);
        const bool resets = !forms_.is_unreset(path) || !llvm::isa<llvm::ConstantInt>(initial);
        builder.CreateStore(resets ? static_cast<llvm::Value*>(initial) : make_power_up(builder, initial), slot);
      }
    }
    return slot;
  }

  unsigned object_for(const path_steps& path, const std::vector<index_role>& roles) {
    const auto [found, is_new] = objects_.try_emplace(key_of(path, roles), 0);
    if (!is_new) return found->second;
    std::vector<bool> is_address;
    std::uint64_t words = 1;
    for (std::size_t i = 0; i < path.size(); ++i) {
      is_address.push_back(roles[i] == index_role::address);
      if (is_address.back()) words *= path[i].size();
    }
    const std::string name = variable_.name + path_name(variable_, path, is_address, layout_);
    const unsigned width = scalar_type(path)->getIntegerBitWidth();
    if (words > (1u << 24))
      refuse(variable_.place,
             fmt::format("'{}' has {} words: too large for memory on the chip", variable_.name, words));
    std::vector<llvm::APInt> initial;
    if (variable_.initial != nullptr) {
      path_steps at = path;
      fill_initial(at, roles, 0, width, initial);
    }
    if (variable_.is_constant) {
      found->second = static_cast<unsigned>(result_.tables.size());
      result_.tables.push_back({name, width, std::move(initial), false, {}});
      result_.table_places.push_back(variable_.place);
    } else {
      found->second = static_cast<unsigned>(result_.memories.size());
      dataflow::memory made_memory;
      made_memory.name = name;
      made_memory.words = static_cast<unsigned>(words);
      made_memory.width = width;
      made_memory.initial = std::move(initial);
      if (const unsigned distance = forms_.promised_distance(path); distance > 1) {
        made_memory.distance = distance;
        made_memory.distance_promised = true;
      }
      result_.memories.push_back(std::move(made_memory));
      result_.memory_places.push_back(variable_.place);
    }
    return found->second;
  }

  void fill_initial(path_steps& path, const std::vector<index_role>& roles, std::size_t from, unsigned width,
                    std::vector<llvm::APInt>& words) const {
    for (std::size_t i = from; i < path.size(); ++i) {
      if (roles[i] != index_role::address) continue;
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

  splitting& shared_;
  lowered_process& result_;
  llvm::Function& function_;
  const llvm::DataLayout& layout_;
  const variable& variable_;
  variable_accesses found_;
  array_forms forms_;
  std::map<std::string, llvm::AllocaInst*> scalars_;
  std::map<std::string, unsigned> objects_;
};

}  // namespace

void split_aggregates(lowered_process& result) {
  const std::vector<variable> variables = find_variables(*result.function);
  splitting shared(result);
  for (const variable& of : variables) splitter(shared, of).split();
  promote(*result.function, shared.scalars);
}

}  // namespace epiline::frontend
