#include "frontend/build_graph.hpp"

#include <fmt/format.h>
#include <llvm/ADT/SmallString.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <unordered_map>

#include "frontend/power_up.hpp"
#include "frontend/steps.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

using dataflow::node_id;
using dataflow::operation;
using llvm::BasicBlock;
using llvm::Instruction;
using llvm::Value;

/// An edge of the control flow.
struct edge {
  const BasicBlock* from;
  const BasicBlock* to;
  auto operator<=>(const edge&) const = default;
};

class graph_builder {
 public:
  graph_builder(lowered_process& process, const std::string& name) : steps_(cut_into_steps(process)) {
    graph_.name = name;
    graph_.ports = process.ports;
    for (dataflow::port& port : graph_.ports) port.where = location(process.top_place);
    graph_.memories = process.memories;
    graph_.tables = process.tables;
    for (std::size_t i = 0; i < graph_.memories.size(); ++i)
      graph_.memories[i].where = location(process.memory_places[i]);
    for (std::size_t i = 0; i < graph_.tables.size(); ++i) graph_.tables[i].where = location(process.table_places[i]);
  }

  dataflow::graph build() {
    index_blocks();
    find_live_values();
    fold_start();
    assign_registers();
    for (const BasicBlock* block : steps_.order) collect_accesses(*block);
    build_effects();
    build_registers();
    sort_nodes();
    return std::move(graph_);
  }

 private:
  // ---- nodes -------------------------------------------------------------------------------------------------------

  dataflow::source_location location(const source_place& place) {
    if (place.line == 0) return {};
    const auto [found, is_new] = file_numbers_.try_emplace(place.file, static_cast<std::uint32_t>(graph_.files.size()));
    if (is_new) graph_.files.push_back(place.file);
    return {found->second, place.line};
  }

  node_id add(operation kind, unsigned width, std::vector<node_id> operands, dataflow::source_location where = {}) {
    dataflow::node made;
    made.kind = kind;
    made.width = width;
    made.operands = std::move(operands);
    made.where = where;
    graph_.nodes.push_back(std::move(made));
    return static_cast<node_id>(graph_.nodes.size() - 1);
  }

  node_id constant(const llvm::APInt& value) {
    llvm::SmallString<40> digits;
    value.toString(digits, 16, false);
    const auto key = std::make_pair(value.getBitWidth(), std::string(digits));
    const auto [found, is_new] = constants_.try_emplace(key, 0);
    if (is_new) {
      found->second = add(operation::constant, value.getBitWidth(), {});
      graph_.nodes.back().value = value;
    }
    return found->second;
  }

  node_id bit(bool value) { return constant(llvm::APInt(1, value ? 1 : 0)); }

  [[nodiscard]] bool is_bit(node_id id, bool value) const {
    const dataflow::node& n = graph_.nodes[id];
    return n.kind == operation::constant && n.width == 1 && n.value == (value ? 1u : 0u);
  }

  node_id both(node_id a, node_id b) {
    if (is_bit(a, true) || a == b) return b;
    if (is_bit(b, true)) return a;
    if (is_bit(a, false) || is_bit(b, false)) return bit(false);
    return shared(operation::bit_and, a, b);
  }

  node_id either(node_id a, node_id b) {
    if (is_bit(a, false) || a == b) return b;
    if (is_bit(b, false)) return a;
    if (is_bit(a, true) || is_bit(b, true)) return bit(true);
    if (complement(a) == b || complement(b) == a) return bit(true);
    return shared(operation::bit_or, a, b);
  }

  node_id inverse(node_id a) {
    if (is_bit(a, true)) return bit(false);
    if (is_bit(a, false)) return bit(true);
    if (const node_id known = complement(a); known != dataflow::none) return known;
    const node_id made = shared(operation::bit_not, a, a);
    complements_[a] = made;
    complements_[made] = a;
    return made;
  }

  node_id complement(node_id a) const {
    const auto found = complements_.find(a);
    return found == complements_.end() ? dataflow::none : found->second;
  }

  /// One node for one predicate expression.
  node_id shared(operation kind, node_id a, node_id b) {
    if (b < a) std::swap(a, b);
    const auto [found, is_new] = predicates_.try_emplace({static_cast<unsigned>(kind), a, b}, 0);
    if (is_new) found->second = kind == operation::bit_not ? add(kind, 1, {a}) : add(kind, 1, {a, b});
    return found->second;
  }

  node_id choose(node_id condition, node_id one, node_id zero) {
    if (one == zero || is_bit(condition, true)) return one;
    if (is_bit(condition, false)) return zero;
    return add(operation::select, graph_.nodes[one].width, {condition, one, zero}, graph_.nodes[one].where);
  }

  // ---- control flow ------------------------------------------------------------------------------------------------

  void index_blocks() {
    for (std::size_t i = 0; i < steps_.order.size(); ++i) position_[steps_.order[i]] = static_cast<int>(i);
    const std::size_t count = steps_.order.size();
    reaches_.assign(count, std::vector<bool>(count, false));
    for (std::size_t i = count; i-- > 0;) {
      reaches_[i][i] = true;
      for (const BasicBlock* next : llvm::successors(steps_.order[i])) {
        if (steps_.is_cut(next)) continue;
        const auto n = static_cast<std::size_t>(position_.at(next));
        for (std::size_t j = 0; j < count; ++j)
          if (reaches_[n][j]) reaches_[i][j] = true;
      }
    }
    find_dominators();
  }

  /// Whether a step can run through `from` and then `to`.
  [[nodiscard]] bool reaches(const BasicBlock* from, const BasicBlock* to) const {
    return reaches_[static_cast<std::size_t>(position_.at(from))][static_cast<std::size_t>(position_.at(to))];
  }

  std::vector<const BasicBlock*> step_predecessors(const BasicBlock* block) const {
    std::vector<const BasicBlock*> result;
    if (steps_.is_cut(block)) return result;
    for (const BasicBlock* before : llvm::predecessors(block))
      if (std::find(result.begin(), result.end(), before) == result.end()) result.push_back(before);
    return result;
  }

  static bool is_impossible(const BasicBlock* block) {
    return llvm::isa<llvm::UnreachableInst>(block->getTerminator());
  }

  /// Dominators and postdominators within a step, as positions; -1 = the virtual start or end.
  void find_dominators() {
    const int count = static_cast<int>(steps_.order.size());
    dominator_.assign(static_cast<std::size_t>(count), -1);
    for (int i = 0; i < count; ++i) {
      const BasicBlock* block = steps_.order[static_cast<std::size_t>(i)];
      if (steps_.is_cut(block)) continue;
      int common = -2;
      for (const BasicBlock* before : step_predecessors(block)) {
        int at = position_.at(before);
        if (common == -2) {
          common = at;
          continue;
        }
        while (common != at) {
          if (common > at)
            common = dominator_[static_cast<std::size_t>(common)];
          else
            at = dominator_[static_cast<std::size_t>(at)];
          if (common == -1 || at == -1) {
            common = -1;
            break;
          }
        }
        if (common == -1) break;
      }
      dominator_[static_cast<std::size_t>(i)] = common == -2 ? -1 : common;
    }
    // `count` is the end of the step.
    postdominator_.assign(static_cast<std::size_t>(count), count);
    for (int i = count - 1; i >= 0; --i) {
      int common = -2;
      for (const BasicBlock* next : llvm::successors(steps_.order[static_cast<std::size_t>(i)])) {
        if (is_impossible(next)) continue;
        int at = steps_.is_cut(next) ? count : position_.at(next);
        if (common == -2) {
          common = at;
          continue;
        }
        while (common != at) {
          if (common < at)
            common = common == count ? count : postdominator_[static_cast<std::size_t>(common)];
          else
            at = at == count ? count : postdominator_[static_cast<std::size_t>(at)];
          if (common == count || at == count) {
            common = count;
            break;
          }
        }
        if (common == count) break;
      }
      postdominator_[static_cast<std::size_t>(i)] = common == -2 ? count : common;
    }
  }

  [[nodiscard]] bool dominates(const BasicBlock* above, const BasicBlock* below) const {
    const int target = position_.at(above);
    for (int at = position_.at(below); at >= 0; at = dominator_[static_cast<std::size_t>(at)])
      if (at == target) return true;
    return false;
  }

  /// 1 in the steps that start at cut `number`.
  node_id at_cut(unsigned number) const { return state_values_[number]; }

  /// Whether a step runs through the block, given that it runs through `root` (null: given nothing).
  node_id predicate(const BasicBlock* block, const BasicBlock* root = nullptr) {
    if (block == root) return bit(true);
    const auto key = std::make_pair(block, root);
    if (const auto found = block_predicates_.find(key); found != block_predicates_.end()) return found->second;
    node_id result = bit(false);
    if (steps_.is_cut(block)) {
      result = root != nullptr ? bit(false) : at_cut(steps_.cut_number.at(block));
    } else if (const BasicBlock* twin = always_with(block);
               twin != nullptr && (root == nullptr || dominates(root, twin))) {
      result = predicate(twin, root);
    } else {
      for (const BasicBlock* before : step_predecessors(block))
        if (root == nullptr || before == root || reaches(root, before))
          result = either(result, edge_predicate({before, block}, root));
    }
    block_predicates_[key] = result;
    return result;
  }

  /// The dominator that is always followed by this block: the two run together.
  const BasicBlock* always_with(const BasicBlock* block) const {
    const int self = position_.at(block);
    const int above = dominator_[static_cast<std::size_t>(self)];
    if (above < 0) return nullptr;
    for (int at = above; at < static_cast<int>(steps_.order.size()) && at <= self;
         at = postdominator_[static_cast<std::size_t>(at)])
      if (at == self) return steps_.order[static_cast<std::size_t>(above)];
    return nullptr;
  }

  node_id edge_predicate(const edge& along, const BasicBlock* root = nullptr) {
    const auto key = std::make_pair(along, root);
    if (const auto found = edge_predicates_.find(key); found != edge_predicates_.end()) return found->second;
    node_id taken = bit(true);
    const Instruction* end = along.from->getTerminator();
    if (const auto* branch = llvm::dyn_cast<llvm::BranchInst>(end)) {
      if (branch->isConditional() && branch->getSuccessor(0) != branch->getSuccessor(1) &&
          !is_impossible(branch->getSuccessor(0)) && !is_impossible(branch->getSuccessor(1))) {
        const node_id condition = use(branch->getCondition(), along.from);
        taken = branch->getSuccessor(0) == along.to ? condition : inverse(condition);
      }
    } else if (const auto* choice = llvm::dyn_cast<llvm::SwitchInst>(end)) {
      taken = switch_edge(*choice, along);
    }
    const node_id result = both(predicate(along.from, root), taken);
    edge_predicates_[key] = result;
    return result;
  }

  node_id switch_edge(const llvm::SwitchInst& choice, const edge& along) {
    const node_id value = use(choice.getCondition(), along.from);
    node_id cases = bit(false);
    node_id elsewhere = bit(false);
    for (const auto& one : choice.cases()) {
      const node_id here = equal(value, constant(one.getCaseValue()->getValue()));
      if (one.getCaseSuccessor() == along.to)
        cases = either(cases, here);
      else if (!is_impossible(one.getCaseSuccessor()))
        elsewhere = either(elsewhere, here);
    }
    return choice.getDefaultDest() == along.to ? inverse(elsewhere) : cases;
  }

  node_id equal(node_id a, node_id b) { return shared(operation::equal, a, b); }

  // ---- values across steps -----------------------------------------------------------------------------------------

  static bool is_local(const Value* value) { return llvm::isa<Instruction>(value) && !value->getType()->isVoidTy(); }

  [[nodiscard]] bool is_cut_phi(const Value* value) const {
    const auto* phi = llvm::dyn_cast<llvm::PHINode>(value);
    return phi != nullptr && steps_.is_cut(phi->getParent());
  }

  /// For every cut block the values that must be in a register when a step starts there: its phis, and what was
  /// computed in earlier steps and is used from here on.
  void find_live_values() {
    live_.resize(steps_.cuts.size());
    for (const BasicBlock* block : steps_.order)
      for (const Instruction& instruction : *block) {
        if (!is_local(&instruction)) continue;
        std::set<const BasicBlock*> seen;
        std::vector<const BasicBlock*> pending;
        const auto live_into = [&](const BasicBlock* at) {
          if (at == block && !llvm::isa<llvm::PHINode>(instruction)) return;
          if (at == block && llvm::isa<llvm::PHINode>(instruction) && !steps_.is_cut(block)) return;
          if (!seen.insert(at).second) return;
          if (steps_.is_cut(at)) live_[steps_.cut_number.at(at)].insert(&instruction);
          if (at == block) return;
          for (const BasicBlock* before : llvm::predecessors(at)) pending.push_back(before);
        };
        for (const llvm::Use& one : instruction.uses()) {
          const auto* user = llvm::cast<Instruction>(one.getUser());
          const BasicBlock* at = user->getParent();
          if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(user)) at = phi->getIncomingBlock(one);
          if (at == block && !is_cut_phi(&instruction)) continue;
          live_into(at);
          while (!pending.empty()) {
            const BasicBlock* next = pending.back();
            pending.pop_back();
            live_into(next);
          }
        }
      }
    for (auto& values : live_) {
      ordered_live_.emplace_back(values.begin(), values.end());
      std::sort(ordered_live_.back().begin(), ordered_live_.back().end(),
                [this](const Instruction* a, const Instruction* b) { return comes_before(a, b); });
    }
  }

  bool comes_before(const Instruction* a, const Instruction* b) {
    if (instruction_numbers_.empty()) {
      unsigned number = 0;
      for (const BasicBlock* block : steps_.order)
        for (const Instruction& instruction : *block) instruction_numbers_[&instruction] = number++;
    }
    return instruction_numbers_.at(a) < instruction_numbers_.at(b);
  }

  /// The function's entry only sets initial values: when it goes straight to another cut with constants, the machine
  /// starts there and the constants become reset values.
  void fold_start() {
    start_ = steps_.cuts.front();
    const BasicBlock* entry = start_;
    const BasicBlock* last = entry;
    start_path_ = {entry};
    const BasicBlock* next = entry->getSingleSuccessor();
    while (next != nullptr && !steps_.is_cut(next)) {
      if (!is_pure(*next)) return;
      last = next;
      start_path_.push_back(last);
      next = next->getSingleSuccessor();
    }
    if (next == nullptr || !is_pure(*entry)) return;
    start_path_.push_back(next);
    const bool is_kept_at_reset =
        std::any_of(entry->begin(), entry->end(), [](const Instruction& at) { return power_up_value(&at) != nullptr; });
    // More than constants that the cut itself chooses only where it must be: a step that sets state would do so after
    // each reset.
    for (const llvm::PHINode& phi : next->phis())
      if (is_kept_at_reset ? value_at_start(&phi).number == nullptr
                           : !llvm::isa<llvm::Constant>(phi.getIncomingValueForBlock(last)))
        return;
    for (const Instruction* value : live_[steps_.cut_number.at(next)]) {
      const bool is_of_next = is_cut_phi(value) && value->getParent() == next;
      if (!is_of_next && (!is_kept_at_reset || value_at_start(value).number == nullptr)) return;
    }
    start_ = next;
    start_predecessor_ = last;
  }

  struct start_value {
    llvm::Constant* number = nullptr;  // null: not a constant
    bool is_kept_at_reset = false;
  };

  /// What a value is on the way from the function's entry to the first cut.
  start_value value_at_start(const llvm::Value* value) const {
    if (auto* number = llvm::dyn_cast<llvm::Constant>(value)) return {const_cast<llvm::Constant*>(number), false};
    if (const llvm::Constant* number = power_up_value(value)) return {const_cast<llvm::Constant*>(number), true};
    const auto* at = llvm::dyn_cast<Instruction>(value);
    if (at == nullptr) return {};
    const auto home = std::find(start_path_.begin(), start_path_.end(), at->getParent());
    if (home == start_path_.end()) return {};
    if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(at))
      return home == start_path_.begin() ? start_value()
                                         : value_at_start(phi->getIncomingValueForBlock(*std::prev(home)));
    if (!at->getType()->isIntegerTy() || at->mayReadOrWriteMemory()) return {};
    start_value result;
    llvm::SmallVector<llvm::Constant*> operands;
    for (const llvm::Value* operand : at->operands()) {
      const start_value of_operand = value_at_start(operand);
      if (of_operand.number == nullptr) return {};
      operands.push_back(of_operand.number);
      result.is_kept_at_reset |= of_operand.is_kept_at_reset;
    }
    result.number = fold_constants(*at, operands);
    return result;
  }

  static bool is_pure(const BasicBlock& block) {
    return std::all_of(block.begin(), block.end(), [](const Instruction& at) { return access_of(at) == access::none; });
  }

  /// One register can serve several values that are never alive at the same cut: above all the phis of one variable.
  void assign_registers() {
    std::map<const Instruction*, std::set<unsigned>> alive;  // at which cuts
    for (unsigned cut = 0; cut < ordered_live_.size(); ++cut)
      if (runs(cut))
        for (const Instruction* value : ordered_live_[cut]) alive[value].insert(cut);
    std::vector<const Instruction*> values;
    for (const auto& [value, cuts] : alive) values.push_back(value);
    std::sort(values.begin(), values.end(),
              [this](const Instruction* a, const Instruction* b) { return comes_before(a, b); });

    std::map<const Instruction*, const Instruction*> leader;
    std::map<const Instruction*, std::set<unsigned>> occupied = alive;
    const auto find = [&](const Instruction* value) {
      while (leader.count(value) != 0) value = leader.at(value);
      return value;
    };
    for (const Instruction* value : values) {
      if (!is_cut_phi(value)) continue;
      for (const Value* incoming : llvm::cast<llvm::PHINode>(value)->incoming_values()) {
        const auto* other = llvm::dyn_cast<Instruction>(incoming);
        if (other == nullptr || alive.count(other) == 0) continue;
        // What a patient step computes keeps a register of its own: only then it has time.
        if (!is_cut_phi(other) && only_in_patient_steps(other->getParent())) continue;
        const Instruction* a = find(value);
        const Instruction* b = find(other);
        if (a == b) continue;
        const auto& in_a = occupied.at(a);
        if (std::any_of(in_a.begin(), in_a.end(), [&](unsigned cut) { return occupied.at(b).count(cut) != 0; }))
          continue;
        occupied.at(a).insert(occupied.at(b).begin(), occupied.at(b).end());
        leader[b] = a;
      }
    }
    for (const Instruction* value : values) {
      const Instruction* first = find(value);
      const auto [found, is_new] =
          register_numbers_.try_emplace(first, static_cast<dataflow::register_id>(graph_.registers.size()));
      if (is_new) {
        dataflow::register_state made;
        made.name = readable(*first);
        made.width = first->getType()->getIntegerBitWidth();
        made.where = location(place_of(*first));
        graph_.registers.push_back(std::move(made));
        const node_id read =
            add(operation::register_value, graph_.registers.back().width, {}, graph_.registers.back().where);
        graph_.nodes[read].object = found->second;
        graph_.nodes[read].name = graph_.registers.back().name;
        register_values_.push_back(read);
      }
      register_of_[value] = found->second;
    }
    make_states();
  }

  [[nodiscard]] bool runs(unsigned cut) const {
    return steps_.cuts[cut] == start_ || cut != 0 || start_predecessor_ == nullptr;
  }

  /// One-hot: a bit for each cut.
  void make_states() {
    std::vector<unsigned> running;
    for (unsigned cut = 0; cut < steps_.cuts.size(); ++cut)
      if (runs(cut)) running.push_back(cut);
    state_values_.assign(steps_.cuts.size(), bit(false));
    if (running.size() < 2) {
      for (const unsigned cut : running) state_values_[cut] = bit(true);
      return;
    }
    for (const unsigned cut : running) {
      dataflow::register_state made;
      made.where = location(place_of(*steps_.cuts[cut]->getTerminator()));
      made.name = fmt::format("at_line_{}", made.where.line);
      made.initial = llvm::APInt(1, steps_.cuts[cut] == start_ ? 1 : 0);
      state_registers_.emplace_back(cut, static_cast<dataflow::register_id>(graph_.registers.size()));
      const node_id read = add(operation::register_value, 1, {}, made.where);
      graph_.nodes[read].object = state_registers_.back().second;
      graph_.nodes[read].name = made.name;
      graph_.registers.push_back(std::move(made));
      register_values_.push_back(read);
      state_values_[cut] = read;
    }
  }

  // ---- values in a step --------------------------------------------------------------------------------------------

  /// The value as the end of block `at` (or an instruction in it) sees it.
  node_id use(const Value* value, const BasicBlock* at) {
    if (const auto* number = llvm::dyn_cast<llvm::ConstantInt>(value)) return constant(number->getValue());
    if (llvm::isa<llvm::UndefValue>(value)) return constant(llvm::APInt(value->getType()->getIntegerBitWidth(), 0));
    const auto* instruction = llvm::dyn_cast<Instruction>(value);
    if (instruction == nullptr)
      refuse({}, fmt::format("internal: a value of kind {} reached the dataflow graph", value->getValueID()));
    if (is_cut_phi(instruction)) return register_value(instruction);
    const BasicBlock* home = instruction->getParent();
    if (home == at || (reaches(home, at) && dominates(home, at))) return node_of(*instruction);
    if (!reaches(home, at)) return register_value(instruction);
    // Some steps come through its definition, others need what an earlier step left.
    const auto key = std::make_pair(instruction, at);
    if (const auto found = mixed_.find(key); found != mixed_.end()) return found->second;
    const node_id chosen = choose(predicate(home), node_of(*instruction), register_value(instruction));
    mixed_[key] = chosen;
    return chosen;
  }

  node_id register_value(const Instruction* value) {
    const auto found = register_of_.find(value);
    if (found == register_of_.end())  // never computed before a running step needs it
      return constant(llvm::APInt(value->getType()->getIntegerBitWidth(), 0));
    return register_values_[found->second];
  }

  node_id node_of(const Instruction& instruction) {
    if (const auto found = nodes_.find(&instruction); found != nodes_.end()) return found->second;
    const node_id made = translate(instruction);
    nodes_[&instruction] = made;
    if (dataflow::node& n = graph_.nodes[made]; n.kind != operation::constant && n.kind != operation::register_value) {
      if (n.where.line == 0) n.where = location(place_of(instruction.getDebugLoc()));
      if (n.name.empty()) n.name = readable(instruction);
    }
    return made;
  }

  /// The source variable this value belongs to, by debug information or by the name the splitting gave it.
  static std::string readable(const Instruction& instruction) {
    llvm::SmallVector<llvm::DbgVariableIntrinsic*> intrinsics;
    llvm::SmallVector<llvm::DbgVariableRecord*> records;
    llvm::findDbgUsers(intrinsics, const_cast<Instruction*>(&instruction), &records);
    if (llvm::isa<llvm::PHINode>(instruction) && instruction.hasName()) {
      llvm::StringRef name = instruction.getName().split('.').first;
      if (!name.empty() && name != "cond") return name.rtrim('_').str();
    }
    for (const llvm::DbgVariableRecord* record : records) {
      const llvm::StringRef name = record->getVariable()->getName().rtrim('_');
      if (!name.empty() && name != "this") return name.str();
    }
    return {};
  }

  node_id translate(const Instruction& at) {
    const BasicBlock* block = at.getParent();
    const auto operand = [&](unsigned i) { return use(at.getOperand(i), block); };
    const unsigned width = at.getType()->isIntegerTy() ? at.getType()->getIntegerBitWidth() : 0;
    if (width == 0) refuse_instruction(at);
    const auto binary = [&](operation kind) { return add(kind, width, {operand(0), operand(1)}); };
    switch (at.getOpcode()) {
      case Instruction::Add:
        return binary(operation::add);
      case Instruction::Sub:
        return binary(operation::subtract);
      case Instruction::Mul:
        return binary(operation::multiply);
      case Instruction::UDiv:
        return binary(operation::divide_unsigned);
      case Instruction::SDiv:
        return binary(operation::divide_signed);
      case Instruction::URem:
        return binary(operation::remainder_unsigned);
      case Instruction::SRem:
        return binary(operation::remainder_signed);
      case Instruction::And:
        return binary(operation::bit_and);
      case Instruction::Or:
        return binary(operation::bit_or);
      case Instruction::Xor:
        return binary(operation::bit_xor);
      case Instruction::Shl:
        return binary(operation::shift_left);
      case Instruction::LShr:
        return binary(operation::shift_right_logical);
      case Instruction::AShr:
        return binary(operation::shift_right_arithmetic);
      case Instruction::ZExt:
        return add(operation::extend_zero, width, {operand(0)});
      case Instruction::SExt:
        return add(operation::extend_sign, width, {operand(0)});
      case Instruction::Trunc:
        return add(operation::slice, width, {operand(0)});
      case Instruction::Freeze:
        return operand(0);
      case Instruction::Select:
        return choose(operand(0), operand(1), operand(2));
      case Instruction::ICmp:
        return compare(llvm::cast<llvm::ICmpInst>(at));
      case Instruction::PHI:
        return join(llvm::cast<llvm::PHINode>(at));
      case Instruction::Call:
        return call(llvm::cast<llvm::CallInst>(at));
      default:
        refuse_instruction(at);
    }
  }

  [[noreturn]] static void refuse_instruction(const Instruction& at) {
    const source_place place = place_of(at);
    if (at.getType()->isFloatingPointTy() ||
        (at.getNumOperands() != 0 && at.getOperand(0)->getType()->isFloatingPointTy()))
      refuse(place, "floating point arithmetic: use ap_int/ap_uint (fixed point) instead");
    if (at.getType()->isPointerTy() || llvm::isa<llvm::LoadInst>(at) || llvm::isa<llvm::StoreInst>(at))
      refuse(place, "a pointer that is not known at compile time: use array indices");
    const auto* call = llvm::dyn_cast<llvm::CallInst>(&at);
    const bool is_named = call != nullptr && call->getCalledFunction() != nullptr;
    refuse(place, fmt::format("'{}' has no hardware form here",
                              is_named ? call->getCalledFunction()->getName().str() : at.getOpcodeName()));
  }

  node_id compare(const llvm::ICmpInst& at) {
    const BasicBlock* block = at.getParent();
    if (!at.getOperand(0)->getType()->isIntegerTy()) refuse_instruction(at);
    const node_id a = use(at.getOperand(0), block);
    const node_id b = use(at.getOperand(1), block);
    switch (at.getPredicate()) {
      case llvm::CmpInst::ICMP_EQ:
        return add(operation::equal, 1, {a, b});
      case llvm::CmpInst::ICMP_NE:
        return negated(operation::equal, a, b);
      case llvm::CmpInst::ICMP_ULT:
        return add(operation::less_unsigned, 1, {a, b});
      case llvm::CmpInst::ICMP_UGT:
        return add(operation::less_unsigned, 1, {b, a});
      case llvm::CmpInst::ICMP_UGE:
        return negated(operation::less_unsigned, a, b);
      case llvm::CmpInst::ICMP_ULE:
        return negated(operation::less_unsigned, b, a);
      case llvm::CmpInst::ICMP_SLT:
        return add(operation::less_signed, 1, {a, b});
      case llvm::CmpInst::ICMP_SGT:
        return add(operation::less_signed, 1, {b, a});
      case llvm::CmpInst::ICMP_SGE:
        return negated(operation::less_signed, a, b);
      default:
        return negated(operation::less_signed, b, a);
    }
  }

  node_id negated(operation kind, node_id a, node_id b) { return inverse(add(kind, 1, {a, b})); }

  /// A phi inside a step: selects by the edge taken, relative to the nearest block all edges come through.
  node_id join(const llvm::PHINode& phi) {
    const BasicBlock* block = phi.getParent();
    const int above = dominator_[static_cast<std::size_t>(position_.at(block))];
    const BasicBlock* root = above >= 0 ? steps_.order[static_cast<std::size_t>(above)] : nullptr;
    node_id result = dataflow::none;
    for (unsigned i = phi.getNumIncomingValues(); i-- > 0;) {
      if (llvm::isa<llvm::UndefValue>(phi.getIncomingValue(i))) continue;
      const BasicBlock* from = phi.getIncomingBlock(i);
      if (position_.count(from) == 0) continue;
      const node_id value = use(phi.getIncomingValue(i), from);
      result = result == dataflow::none ? value : choose(edge_predicate({from, block}, root), value, result);
    }
    return result == dataflow::none ? constant(llvm::APInt(phi.getType()->getIntegerBitWidth(), 0)) : result;
  }

  node_id call(const llvm::CallInst& at) {
    if (access_of(at) == access::read) {
      read_tokens(object_of(at));
      return nodes_.at(&at);
    }
    if (access_of(at) == access::memory_read) return memory_read(at);
    // Where two ways meet, one of them from the function's entry: no step takes that one, the register begins with it.
    if (const llvm::Constant* number = power_up_value(&at); number != nullptr && start_predecessor_ != nullptr)
      return constant(llvm::cast<llvm::ConstantInt>(number)->getValue());
    const BasicBlock* block = at.getParent();
    const unsigned width = at.getType()->getIntegerBitWidth();
    if (access_of(at) == access::table) {
      const node_id address =
          in_address_width(use(at.getArgOperand(1), block), graph_.tables[object_of(at)].values.size());
      const node_id made = add(operation::table, width, {address});
      graph_.nodes[made].object = object_of(at);
      return made;
    }
    const auto operand = [&](unsigned i) { return use(at.getArgOperand(i), block); };
    const auto minimum = [&](operation less, bool maximum) {
      const node_id a = operand(0);
      const node_id b = operand(1);
      const node_id first = add(less, 1, {a, b});
      return maximum ? choose(first, b, a) : choose(first, a, b);
    };
    const node_id zero = constant(llvm::APInt(width, 0));
    switch (at.getIntrinsicID()) {
      case llvm::Intrinsic::umin:
        return minimum(operation::less_unsigned, false);
      case llvm::Intrinsic::umax:
        return minimum(operation::less_unsigned, true);
      case llvm::Intrinsic::smin:
        return minimum(operation::less_signed, false);
      case llvm::Intrinsic::smax:
        return minimum(operation::less_signed, true);
      case llvm::Intrinsic::abs: {
        const node_id a = operand(0);
        return choose(add(operation::less_signed, 1, {a, zero}), add(operation::subtract, width, {zero, a}), a);
      }
      case llvm::Intrinsic::usub_sat: {
        const node_id a = operand(0);
        const node_id b = operand(1);
        return choose(add(operation::less_unsigned, 1, {a, b}), zero, add(operation::subtract, width, {a, b}));
      }
      case llvm::Intrinsic::uadd_sat: {
        const node_id a = operand(0);
        const node_id sum = add(operation::add, width, {a, operand(1)});
        return choose(add(operation::less_unsigned, 1, {sum, a}), constant(llvm::APInt::getAllOnes(width)), sum);
      }
      case llvm::Intrinsic::fshl:
      case llvm::Intrinsic::fshr:
        return funnel_shift(at, at.getIntrinsicID() == llvm::Intrinsic::fshl);
      case llvm::Intrinsic::bitreverse:
        return permuted(operand(0), width, 1);
      case llvm::Intrinsic::bswap:
        return permuted(operand(0), width, 8);
      case llvm::Intrinsic::ctpop:
        return population_count(operand(0), width);
      case llvm::Intrinsic::ctlz:
        return leading_zeros(permuted(operand(0), width, 1), width);
      case llvm::Intrinsic::cttz:
        return leading_zeros(operand(0), width);
      default:
        refuse_instruction(at);
    }
  }

  node_id funnel_shift(const llvm::CallInst& at, bool left) {
    const BasicBlock* block = at.getParent();
    const unsigned width = at.getType()->getIntegerBitWidth();
    const node_id high = use(at.getArgOperand(0), block);
    const node_id low = use(at.getArgOperand(1), block);
    const node_id amount = add(operation::remainder_unsigned, width,
                               {use(at.getArgOperand(2), block), constant(llvm::APInt(width, width))});
    const node_id both_words = add(operation::concat, 2 * width, {high, low});
    const node_id shifted =
        add(left ? operation::shift_left : operation::shift_right_logical, 2 * width, {both_words, amount});
    const node_id result = add(operation::slice, width, {shifted});
    graph_.nodes[result].low = left ? width : 0;
    return result;
  }

  node_id bits_of(node_id a, unsigned low, unsigned width) {
    const node_id made = add(operation::slice, width, {a});
    graph_.nodes[made].low = low;
    return made;
  }

  /// Groups of `group` bits in reverse order.
  node_id permuted(node_id a, unsigned width, unsigned group) {
    std::vector<node_id> parts;
    for (unsigned low = 0; low < width; low += group) parts.push_back(bits_of(a, low, group));
    return parts.size() == 1 ? a : add(operation::concat, width, parts);
  }

  node_id population_count(node_id a, unsigned width) {
    std::vector<node_id> sums;
    for (unsigned i = 0; i < width; ++i)
      sums.push_back(width == 1 ? a : add(operation::extend_zero, width, {bits_of(a, i, 1)}));
    while (sums.size() > 1) {
      std::vector<node_id> half;
      for (std::size_t i = 0; i < sums.size(); i += 2)
        half.push_back(i + 1 < sums.size() ? add(operation::add, width, {sums[i], sums[i + 1]}) : sums[i]);
      sums = std::move(half);
    }
    return sums.front();
  }

  /// Zeros below the lowest one; `width` when there is none.
  node_id leading_zeros(node_id a, unsigned width) {
    node_id count = constant(llvm::APInt(width, width));
    for (unsigned i = width; i-- > 0;)
      count = choose(width == 1 ? a : bits_of(a, i, 1), constant(llvm::APInt(width, i)), count);
    return count;
  }

  // ---- accesses ----------------------------------------------------------------------------------------------------

  struct access_list {
    std::vector<const llvm::CallInst*> reads;
    std::vector<const llvm::CallInst*> writes;
  };

  void collect_accesses(const BasicBlock& block) {
    if (!runs_block(&block)) return;
    for (const Instruction& instruction : block) {
      const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
      switch (access_of(instruction)) {
        case access::read:
          port_accesses_[object_of(instruction)].reads.push_back(call);
          break;
        case access::write:
          port_accesses_[object_of(instruction)].writes.push_back(call);
          break;
        case access::memory_read:
          memory_accesses_[object_of(instruction)].reads.push_back(call);
          break;
        case access::memory_write:
          memory_accesses_[object_of(instruction)].writes.push_back(call);
          break;
        default:
          break;
      }
    }
  }

  bool runs_block(const BasicBlock* block) const {
    for (unsigned cut = 0; cut < steps_.cuts.size(); ++cut)
      if (runs(cut) && reaches(steps_.cuts[cut], block)) return true;
    return false;
  }

  /// All reads of a port are one node: a step takes at most one of its tokens.
  void read_tokens(unsigned port) {
    const std::vector<const llvm::CallInst*>& reads = port_accesses_[port].reads;
    if (nodes_.count(reads.front()) != 0) return;
    node_id wanted = bit(false);
    for (const llvm::CallInst* read : reads) wanted = either(wanted, predicate(read->getParent()));
    const node_id made = add(operation::read, graph_.ports[port].width, {wanted}, location(place_of(*reads.front())));
    graph_.nodes[made].object = port;
    graph_.nodes[made].name = graph_.ports[port].name;
    for (const llvm::CallInst* read : reads) nodes_[read] = made;
  }

  /// What a write of a step earlier in program order leaves for a read of the same step is forwarded here, so that in
  /// the graph all reads of a memory stand before its write.
  node_id memory_read(const llvm::CallInst& at) {
    const unsigned object = object_of(at);
    const node_id address = memory_address(at);
    const node_id enable = predicate(at.getParent());
    const auto [found, is_new] = memory_reads_.try_emplace({object, address, enable}, 0);
    if (is_new) {
      found->second =
          add(operation::memory_read, graph_.memories[object].width, {address, enable}, location(place_of(at)));
      graph_.nodes[found->second].object = object;
      graph_.nodes[found->second].name = graph_.memories[object].name;
    }
    node_id value = found->second;
    for (const llvm::CallInst* write : memory_accesses_[object].writes) {
      const bool earlier =
          write->getParent() == at.getParent() ? write->comesBefore(&at) : reaches(write->getParent(), at.getParent());
      if (!earlier) continue;
      const node_id same = equal(memory_address(*write), address);
      value = choose(both(write_enable(*write), same), use(write->getArgOperand(2), write->getParent()), value);
    }
    return value;
  }

  node_id write_enable(const llvm::CallInst& write) {
    return both(predicate(write.getParent()), use(write.getArgOperand(3), write.getParent()));
  }

  node_id memory_address(const llvm::CallInst& at) {
    return in_address_width(use(at.getArgOperand(1), at.getParent()), graph_.memories[object_of(at)].words);
  }

  /// An index in as many bits as so many words need: C++ indexes with 64.
  node_id in_address_width(node_id wide, std::uint64_t words) {
    const unsigned width = std::max(1u, llvm::Log2_64_Ceil(words));
    const auto [found, is_new] = addresses_.try_emplace({wide, width}, 0);
    if (is_new) found->second = graph_.nodes[wide].width > width ? bits_of(wide, 0, width) : wide;
    return found->second;
  }

  void build_effects() {
    for (auto& [port, accesses] : port_accesses_) {
      if (!accesses.reads.empty()) read_tokens(port);
      if (!accesses.writes.empty()) build_write(port, accesses.writes);
    }
    for (auto& [object, accesses] : memory_accesses_) {
      if (!accesses.writes.empty()) build_memory_write(object, accesses.writes);
    }
    if (steps_.patient_cut >= 0 && runs(static_cast<unsigned>(steps_.patient_cut)))
      graph_.patient = at_cut(static_cast<unsigned>(steps_.patient_cut));
  }

  void build_write(unsigned port, const std::vector<const llvm::CallInst*>& writes) {
    node_id enable = bit(false);
    node_id token = dataflow::none;
    for (const llvm::CallInst* write : writes) {
      const node_id here = predicate(write->getParent());
      const node_id value = use(write->getArgOperand(1), write->getParent());
      token = token == dataflow::none ? value : choose(here, value, token);
      enable = either(enable, here);
    }
    const node_id made = add(operation::write, 0, {enable, token}, location(place_of(*writes.front())));
    graph_.nodes[made].object = port;
    graph_.nodes[made].name = graph_.ports[port].name;
  }

  void build_memory_write(unsigned object, const std::vector<const llvm::CallInst*>& writes) {
    node_id enable = bit(false);
    node_id address = dataflow::none;
    node_id data = dataflow::none;
    for (const llvm::CallInst* write : writes) {
      const node_id here = write_enable(*write);
      const node_id this_address = memory_address(*write);
      const node_id this_data = use(write->getArgOperand(2), write->getParent());
      address = address == dataflow::none ? this_address : choose(here, this_address, address);
      data = data == dataflow::none ? this_data : choose(here, this_data, data);
      enable = either(enable, here);
    }
    const node_id made = add(operation::memory_write, 0, {address, data, enable}, location(place_of(*writes.front())));
    graph_.nodes[made].object = object;
    graph_.nodes[made].name = graph_.memories[object].name;
  }

  // ---- registers ---------------------------------------------------------------------------------------------------

  /// One way a register gets a new value: on these edges (a predicate), this value.
  struct update {
    node_id value;
    node_id when;
    bool patient;  // only in steps that start at the patient cut
  };

  /// The edges that end a step, with the cut they lead to.
  std::vector<std::pair<edge, unsigned>> ending_edges() const {
    std::vector<std::pair<edge, unsigned>> edges;
    for (const BasicBlock* block : steps_.order) {
      if (!runs_block(block)) continue;
      std::set<const BasicBlock*> seen;
      for (const BasicBlock* next : llvm::successors(block))
        if (steps_.is_cut(next) && seen.insert(next).second && !is_impossible(next))
          edges.push_back({edge{block, next}, steps_.cut_number.at(next)});
    }
    return edges;
  }

  bool only_in_patient_steps(const BasicBlock* block) const {
    if (steps_.patient_cut < 0) return false;
    for (unsigned cut = 0; cut < steps_.cuts.size(); ++cut)
      if (runs(cut) && static_cast<int>(cut) != steps_.patient_cut && reaches(steps_.cuts[cut], block)) return false;
    return true;
  }

  void build_registers() {
    std::vector<std::vector<update>> updates(graph_.registers.size());
    const std::vector<std::pair<edge, unsigned>> ends = ending_edges();
    for (const auto& [along, cut] : ends)
      for (const Instruction* value : ordered_live_[cut]) {
        const dataflow::register_id target = register_of_.at(value);
        const Value* incoming = value;
        if (is_cut_phi(value) && value->getParent() == along.to)
          incoming = llvm::cast<llvm::PHINode>(value)->getIncomingValueForBlock(along.from);
        add_updates(updates[target], target, incoming, along);
      }
    for (const auto& [cut, target] : state_registers_) {
      node_id entered = bit(false);
      for (const auto& [along, to] : ends)
        if (to == cut) entered = either(entered, edge_predicate(along));
      updates[target].push_back({entered, bit(true), false});
    }
    set_initial_values();
    for (dataflow::register_id i = 0; i < updates.size(); ++i) finish_register(i, updates[i]);
  }

  /// On this edge the register takes `incoming`. A value that only merges others is taken apart by the edges it comes
  /// along: where it is the register's own value, nothing is to be done.
  void add_updates(std::vector<update>& updates, dataflow::register_id target, const Value* incoming,
                   const edge& along) {
    if (llvm::isa<llvm::UndefValue>(incoming)) return;
    const auto* merge = llvm::dyn_cast<llvm::PHINode>(incoming);
    if (merge != nullptr && merge->getParent() == along.from && !is_cut_phi(merge) &&
        along.from->getSingleSuccessor() != nullptr) {
      for (const BasicBlock* before : step_predecessors(along.from))
        if (runs_block(before))
          add_updates(updates, target, merge->getIncomingValueForBlock(before), {before, along.from});
      return;
    }
    const node_id next = use(incoming, along.from);
    if (next == register_values_[target]) return;
    const node_id when = edge_predicate(along);
    const bool patient = only_in_patient_steps(along.from);
    for (update& known : updates)
      if (known.value == next) {
        known.when = either(known.when, when);
        known.patient = known.patient && patient;
        return;
      }
    updates.push_back({next, when, patient});
  }

  void finish_register(dataflow::register_id id, const std::vector<update>& updates) {
    dataflow::register_state& state = graph_.registers[id];
    if (updates.empty()) {
      state.next = register_values_[id];
      state.enable = bit(false);
      return;
    }
    node_id next = updates.front().value;
    node_id enable = updates.front().when;
    bool patient = updates.front().patient;
    for (std::size_t i = 1; i < updates.size(); ++i) {
      next = choose(updates[i].when, updates[i].value, next);
      enable = either(enable, updates[i].when);
      patient = patient && updates[i].patient;
    }
    dataflow::register_state& again = graph_.registers[id];
    again.next = next;
    again.enable = enable;
    again.patient = patient;
  }

  /// What the registers hold when the first step starts.
  void set_initial_values() {
    if (start_predecessor_ == nullptr) return;
    std::vector<const Instruction*> values;
    for (const llvm::PHINode& phi : start_->phis()) values.push_back(&phi);
    for (const Instruction* value : ordered_live_[steps_.cut_number.at(start_)])
      if (!is_cut_phi(value) || value->getParent() != start_) values.push_back(value);
    for (const Instruction* instruction : values) {
      const auto found = register_of_.find(instruction);
      if (found == register_of_.end()) continue;
      const start_value value = value_at_start(instruction);
      dataflow::register_state& state = graph_.registers[found->second];
      if (value.is_kept_at_reset) state.resets = false;
      if (const auto* number = llvm::dyn_cast_or_null<llvm::ConstantInt>(value.number))
        state.initial = number->getValue();
    }
  }

  // ---- order -------------------------------------------------------------------------------------------------------

  /// Operands before users, reads of a memory before its write, unused nodes away.
  void sort_nodes() {
    std::vector<node_id> roots;
    for (node_id id = 0; id < graph_.nodes.size(); ++id)
      if (const operation kind = graph_.nodes[id].kind; kind == operation::write || kind == operation::read)
        roots.push_back(id);
    for (const dataflow::register_state& state : graph_.registers) {
      roots.push_back(state.next);
      roots.push_back(state.enable);
    }
    if (graph_.patient != dataflow::none) roots.push_back(graph_.patient);
    for (node_id id = 0; id < graph_.nodes.size(); ++id)
      if (graph_.nodes[id].kind == operation::memory_write) roots.push_back(id);

    std::vector<node_id> placed(graph_.nodes.size(), dataflow::none);
    std::vector<dataflow::node> sorted;
    std::vector<node_id> writes;
    const auto place = [&](node_id root) {
      std::vector<std::pair<node_id, std::size_t>> stack{{root, 0}};
      while (!stack.empty()) {
        const node_id id = stack.back().first;
        const std::size_t next = stack.back().second;
        if (placed[id] != dataflow::none) {
          stack.pop_back();
        } else if (next < graph_.nodes[id].operands.size()) {
          ++stack.back().second;
          if (const node_id operand = graph_.nodes[id].operands[next]; placed[operand] == dataflow::none)
            stack.emplace_back(operand, 0);
        } else {
          placed[id] = static_cast<node_id>(sorted.size());
          sorted.push_back(graph_.nodes[id]);
          for (node_id& operand : sorted.back().operands) operand = placed[operand];
          stack.pop_back();
        }
      }
    };
    // Memory writes last: then every memory read stands before the write of its memory. Their operands first.
    for (const node_id root : roots) {
      if (graph_.nodes[root].kind != operation::memory_write)
        place(root);
      else
        for (const node_id operand : graph_.nodes[root].operands) place(operand);
    }
    for (const node_id root : roots)
      if (graph_.nodes[root].kind == operation::memory_write) place(root);
    for (dataflow::register_state& state : graph_.registers) {
      state.next = placed[state.next];
      state.enable = placed[state.enable];
    }
    if (graph_.patient != dataflow::none) graph_.patient = placed[graph_.patient];
    graph_.nodes = std::move(sorted);
  }

  step_structure steps_;
  dataflow::graph graph_;

  std::map<std::string, std::uint32_t> file_numbers_;
  std::map<std::pair<unsigned, std::string>, node_id> constants_;
  std::map<std::tuple<unsigned, node_id, node_id>, node_id> predicates_;
  std::unordered_map<node_id, node_id> complements_;

  std::unordered_map<const BasicBlock*, int> position_;
  std::vector<std::vector<bool>> reaches_;
  std::vector<int> dominator_;
  std::vector<int> postdominator_;
  std::map<std::pair<const BasicBlock*, const BasicBlock*>, node_id> block_predicates_;
  std::map<std::pair<edge, const BasicBlock*>, node_id> edge_predicates_;

  const BasicBlock* start_ = nullptr;
  const BasicBlock* start_predecessor_ = nullptr;  // in the function's entry; null: the entry is a step of its own
  std::vector<const BasicBlock*> start_path_;      // from the function's entry to the first cut
  std::vector<std::set<const Instruction*>> live_;
  std::vector<std::vector<const Instruction*>> ordered_live_;
  std::unordered_map<const Instruction*, unsigned> instruction_numbers_;
  std::map<const Instruction*, dataflow::register_id> register_numbers_;  // of each group's first value
  std::unordered_map<const Instruction*, dataflow::register_id> register_of_;
  std::vector<node_id> register_values_;
  std::vector<std::pair<unsigned, dataflow::register_id>> state_registers_;
  std::vector<node_id> state_values_;

  std::unordered_map<const Instruction*, node_id> nodes_;
  std::map<std::pair<const Instruction*, const BasicBlock*>, node_id> mixed_;
  std::map<unsigned, access_list> port_accesses_;
  std::map<unsigned, access_list> memory_accesses_;
  std::map<std::tuple<unsigned, node_id, node_id>, node_id> memory_reads_;
  std::map<std::pair<node_id, unsigned>, node_id> addresses_;
};

}  // namespace

dataflow::graph build_graph(lowered_process& process, const std::string& name) {
  return graph_builder(process, name).build();
}

}  // namespace epiline::frontend
