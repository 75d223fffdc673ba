// How it works. Registers start with their initial value alone, memories with their initial contents. Rounds of
// evaluating the nodes let the sets of registers and memories grow until nothing changes; a set that keeps growing is
// widened to the next power of two, so counters settle after a few rounds. Sets are as LLVM computes them for its own
// operations. Behind a condition (arm of a select, enable of a register) more is known: see add_facts.
#include "passes/known_values.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace epiline::passes {

using namespace dataflow;
using llvm::APInt;
using llvm::CmpInst;
using llvm::ConstantRange;

namespace {

constexpr unsigned exact_changes = 3;      // of a register, before its range is widened to powers of two
constexpr unsigned max_changes = 60;       // before nothing is claimed any more
constexpr unsigned max_depth = 4;          // of conditions and expressions looked through for facts
constexpr unsigned reach = 2 * max_depth;  // of what a select is evaluated from: steps from user to operand

ConstantRange widened(const ConstantRange& range) {
  const unsigned width = range.getBitWidth();
  if (range.isFullSet()) return range;
  if (range.getActiveBits() < width)
    return ConstantRange::getNonEmpty(APInt(width, 0), APInt::getOneBitSet(width, range.getActiveBits()));
  const unsigned bits = range.getMinSignedBits();
  if (bits >= width) return ConstantRange::getFull(width);
  const APInt limit = APInt::getOneBitSet(width, bits - 1);
  return ConstantRange::getNonEmpty(-limit, limit);
}

/// Joins `other` into the set of a register or memory, the `changes`th time it grows.
bool grow(value_set& set, const value_set& other, unsigned& changes) {
  if (!set.join(other)) return false;
  ++changes;
  if (changes > max_changes) set = value_set(set.width());
  if (changes > exact_changes) set.range = widened(set.range);
  return true;
}

}  // namespace

known_values::user_lists::user_lists(const graph& g) : begins_(g.nodes.size() + 1, 0) {
  for (const node& n : g.nodes)
    for (const node_id operand : n.operands) ++begins_[operand + 1];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  users_.resize(begins_.back());
  std::vector<std::uint32_t> ends(begins_.begin(), begins_.end() - 1);
  for (node_id id = 0; id < g.nodes.size(); ++id)
    for (const node_id operand : g.nodes[id].operands) users_[ends[operand]++] = id;
}

known_values::known_values(const graph& g)
    : g_(g),
      users_(g),
      steps_to_change_(g.nodes.size(), 0),
      pending_(static_cast<unsigned>(g.nodes.size())),
      register_changed_(g.registers.size(), 1),
      memory_changed_(g.memories.size(), 1) {
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const operation kind = g.nodes[id].kind;
    if (kind == operation::register_value || kind == operation::memory_read) state_reads_.push_back(id);
    if (kind == operation::memory_write) memory_writes_.push_back(id);
  }
  for (const register_state& r : g.registers) registers_.emplace_back(r.initial.value_or(APInt(r.width, 0)));
  // A disabled read, or one past the end, gives 0: so 0 is in every set of words.
  const auto of_words = [](unsigned width, const std::vector<APInt>& words) {
    value_set set{APInt(width, 0)};
    for (const APInt& word : words) set.join(value_set(word));
    return set;
  };
  for (const memory& m : g.memories) memories_.push_back(of_words(m.width, m.initial));
  for (const table& t : g.tables) tables_.push_back(of_words(t.width, t.values));
  nodes_.reserve(g.nodes.size());
  for (const node& n : g.nodes) nodes_.emplace_back(std::max(n.width, 1u));
  iterate();
  for (unsigned pass = 0; pass < 2; ++pass) tighten();
}

void known_values::iterate() {
  std::vector<unsigned> register_changes(g_.registers.size(), 0), memory_changes(g_.memories.size(), 0);
  evaluate_all();
  while (grow_state(register_changes, memory_changes)) evaluate_changed();
}

/// Whether any register or memory can hold more than was known.
bool known_values::grow_state(std::vector<unsigned>& register_changes, std::vector<unsigned>& memory_changes) {
  bool changed = false;
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    register_changed_[r] = 0;
    const auto [next, enable] = std::pair(g_.registers[r].next, g_.registers[r].enable);
    if (std::min(steps_to_change_[next], steps_to_change_[enable]) > reach || is_never(enable)) continue;
    register_changed_[r] = grow(registers_[r], next_of(r), register_changes[r]);
    changed |= register_changed_[r] != 0;
  }
  std::fill(memory_changed_.begin(), memory_changed_.end(), 0);
  for (const node_id write : memory_writes_) {
    const node& n = g_.nodes[write];
    if (is_never(n.operands[2])) continue;
    if (!grow(memories_[n.object], nodes_[n.operands[1]], memory_changes[n.object])) continue;
    memory_changed_[n.object] = 1;
    changed = true;
  }
  return changed;
}

/// Widening may have claimed too little. What a register can become from sets that hold is a set that holds.
void known_values::tighten() {
  std::vector<value_set> sharper;
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    const register_state& state = g_.registers[r];
    value_set set(state.initial.value_or(APInt(state.width, 0)));
    if (!is_never(state.enable)) set.join(next_of(r));
    set.meet(registers_[r]);
    sharper.push_back(std::move(set));
  }
  registers_ = std::move(sharper);
  evaluate_all();
}

void known_values::evaluate_all() {
  reached_.clear();
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    steps_to_change_[id] = 0;
    reached_.push_back(id);
    if (g_.nodes[id].width == 0) continue;
    nodes_[id] = evaluate(id);
    nodes_[id].settle();
  }
}

/// A node is evaluated again when its operands changed. A select looks deeper, but not further than `reach`.
void known_values::evaluate_changed() {
  for (const node_id id : reached_) steps_to_change_[id] = reach + 1;
  reached_.clear();
  for (const node_id id : state_reads_)
    if (has_changed_state(id)) pending_.set(id);
  // Users have larger numbers than their operands.
  for (int at = pending_.find_first(); at >= 0; at = pending_.find_next(static_cast<unsigned>(at))) {
    const auto id = static_cast<node_id>(at);
    pending_.reset(id);
    reached_.push_back(id);
    const node& n = g_.nodes[id];
    unsigned steps = has_changed_state(id) ? 0 : reach + 1;
    for (const node_id operand : n.operands) steps = std::min(steps, steps_to_change_[operand] + 1u);
    if (n.width != 0 && (steps <= 1 || n.kind == operation::select)) {
      value_set again = evaluate(id);
      again.settle();
      const bool is_same = again == nodes_[id];
      steps = is_same ? std::max(steps, 1u) : 0;
      if (!is_same) nodes_[id] = std::move(again);
    }
    steps_to_change_[id] = static_cast<unsigned char>(steps);
    if (steps < reach)
      for (const node_id user : users_.of(id)) pending_.set(user);
  }
}

/// Whether a node reads a register or memory that can hold more than in the round before.
bool known_values::has_changed_state(node_id id) const {
  const node& n = g_.nodes[id];
  return (n.kind == operation::register_value && register_changed_[n.object]) ||
         (n.kind == operation::memory_read && memory_changed_[n.object]);
}

bool known_values::is_never(node_id bit) const { return nodes_[bit].bits.isZero(); }

value_set known_values::next_of(register_id id) const {
  const register_state& r = g_.registers[id];
  fact_list facts;
  add_facts(r.enable, true, max_depth, facts);
  return facts.empty() ? nodes_[r.next] : refined(r.next, facts, max_depth);
}

value_set known_values::evaluate(node_id id) const {
  const node& n = g_.nodes[id];
  switch (n.kind) {
    case operation::constant:
      return value_set(n.value);
    case operation::register_value:
      return registers_[n.object];
    case operation::memory_read:
      return memories_[n.object];
    case operation::table:
      return tables_[n.object];
    case operation::read:
      return is_never(n.operands[0]) ? value_set(APInt(n.width, 0)) : value_set(n.width);
    case operation::select:
      return evaluate_select(n);
    default: {
      llvm::SmallVector<const value_set*, 4> operands;
      for (const node_id operand : n.operands) operands.push_back(&nodes_[operand]);
      return evaluate_sets(n, operands);
    }
  }
}

value_set known_values::evaluate_select(const node& n) const {
  const value_set& condition = nodes_[n.operands[0]];
  if (condition.is_single()) return nodes_[n.operands[condition.bits.isZero() ? 2 : 1]];
  fact_list facts;
  add_facts(n.operands[0], true, max_depth, facts);
  value_set result = refined(n.operands[1], facts, max_depth);
  facts.clear();
  add_facts(n.operands[0], false, max_depth, facts);
  result.join(refined(n.operands[2], facts, max_depth));
  return result;
}

/// Collects what `condition` being 1 (holds) or 0 says about the values it compares.
void known_values::add_facts(node_id condition, bool holds, unsigned depth, fact_list& facts) const {
  const node& n = g_.nodes[condition];
  add_fact(condition, ConstantRange(APInt(1, holds ? 1 : 0)), 0, facts);
  if (depth == 0) return;
  const auto compare = [&](CmpInst::Predicate when_true, CmpInst::Predicate when_false) {
    const node_id x = n.operands[0], y = n.operands[1];
    if (nodes_[x].width() > max_range_width) return;
    const CmpInst::Predicate predicate = holds ? when_true : when_false;
    add_fact(x, ConstantRange::makeAllowedICmpRegion(predicate, nodes_[y].range), depth, facts);
    add_fact(y, ConstantRange::makeAllowedICmpRegion(CmpInst::getSwappedPredicate(predicate), nodes_[x].range), depth,
             facts);
  };
  switch (n.kind) {
    case operation::bit_not:
      return add_facts(n.operands[0], !holds, depth - 1, facts);
    case operation::bit_and:
    case operation::bit_or:
      if (holds != (n.kind == operation::bit_and)) return;
      add_facts(n.operands[0], holds, depth - 1, facts);
      add_facts(n.operands[1], holds, depth - 1, facts);
      return;
    case operation::equal:
      return compare(CmpInst::ICMP_EQ, CmpInst::ICMP_NE);
    case operation::less_unsigned:
      return compare(CmpInst::ICMP_ULT, CmpInst::ICMP_UGE);
    case operation::less_signed:
      return compare(CmpInst::ICMP_SLT, CmpInst::ICMP_SGE);
    case operation::slice: {  // the top bit tells the sign
      const unsigned width = nodes_[n.operands[0]].width();
      if (n.width != 1 || n.low + 1 != width || width > max_range_width) return;
      const APInt least = APInt::getSignedMinValue(width), zero(width, 0);
      add_fact(n.operands[0], holds ? ConstantRange(least, zero) : ConstantRange(zero, least), depth, facts);
      return;
    }
    default:
      return;
  }
}

/// Adds that `subject` lies in `range`, and what that says about the value it was made from.
void known_values::add_fact(node_id subject, ConstantRange range, unsigned depth, fact_list& facts) const {
  if (range.isEmptySet() || range.isFullSet()) return;
  facts.push_back({subject, range});
  if (depth == 0) return;
  const node& n = g_.nodes[subject];
  if (n.operands.empty()) return;
  const node_id a = n.operands[0];
  const unsigned width = n.kind == operation::memory_write ? 0 : nodes_[a].width();
  switch (n.kind) {
    case operation::extend_zero:
    case operation::extend_sign: {
      const bool zero = n.kind == operation::extend_zero;
      const ConstantRange all = ConstantRange::getFull(width);
      const ConstantRange possible = range.intersectWith(zero ? all.zeroExtend(n.width) : all.signExtend(n.width));
      if (!possible.isEmptySet()) add_fact(a, possible.truncate(width), depth - 1, facts);
      return;
    }
    case operation::slice:  // that loses nothing
      if (n.low == 0 && width <= max_range_width && nodes_[a].unsigned_bits() <= n.width)
        add_fact(a, range.zeroExtend(width), depth - 1, facts);
      return;
    case operation::add:
      if (nodes_[n.operands[1]].is_single()) add_fact(a, range.sub(nodes_[n.operands[1]].range), depth - 1, facts);
      return;
    default:
      return;
  }
}

/// The set of a node where the facts hold: its own fact, and its value computed anew from operands the facts are about.
value_set known_values::refined(node_id id, const fact_list& facts, unsigned depth) const {
  value_set result = nodes_[id];
  node_id earliest = none;
  for (const fact& f : facts) {
    earliest = std::min(earliest, f.subject);
    if (f.subject != id) continue;
    value_set from_fact(result.width());
    from_fact.range = f.range;
    result.meet(from_fact);
  }
  const node& n = g_.nodes[id];
  const bool pure = n.kind >= operation::add && n.kind != operation::select;
  if (depth == 0 || !pure || n.operands.empty() || n.operands.size() > 2 || id <= earliest) return result;
  llvm::SmallVector<value_set, 2> sets;
  for (const node_id operand : n.operands) sets.push_back(refined(operand, facts, depth - 1));
  llvm::SmallVector<const value_set*, 2> operands;
  for (const value_set& set : sets) operands.push_back(&set);
  value_set anew = evaluate_sets(n, operands);
  anew.settle();
  result.meet(anew);
  return result;
}

}  // namespace epiline::passes
