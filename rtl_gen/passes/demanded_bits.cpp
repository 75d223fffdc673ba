// How it works. Tokens, conditions, addresses and enables demand all their bits; every node passes what is demanded of
// it on to its operands. Demands only grow, so a work list of nodes whose demand grew ends; taking the latest node
// first visits most nodes once.
#include "passes/demanded_bits.hpp"

#include <algorithm>

namespace epiline::passes {

using namespace dataflow;
using llvm::APInt;

demanded_bits::demanded_bits(const graph& g, const known_values* known)
    : g_(g), known_(known), writes_(g.memories.size()), is_pending_(g.nodes.size(), 0) {
  for (const node& n : g.nodes) nodes_.emplace_back(std::max(n.width, 1u), 0);
  for (const register_state& r : g.registers) registers_.emplace_back(r.width, 0);
  for (const memory& m : g.memories) memories_.emplace_back(m.width, 0);
  for (const table& t : g.tables) tables_.emplace_back(t.width, 0);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind == operation::memory_write) writes_[n.object].push_back(id);
    if (n.kind == operation::read || n.kind == operation::write)
      for (const node_id operand : n.operands) demand_all(operand);
  }
  while (!pending_.empty()) {
    std::pop_heap(pending_.begin(), pending_.end());
    const node_id id = pending_.back();
    pending_.pop_back();
    is_pending_[id] = 0;
    pass_on(id);
  }
}

void demanded_bits::demand(node_id id, APInt bits) {
  if (known_ != nullptr) bits = known_->of_node(id).without_implied(std::move(bits));
  if (bits.isSubsetOf(nodes_[id])) return;
  nodes_[id] |= bits;
  if (is_pending_[id]) return;
  is_pending_[id] = 1;
  pending_.push_back(id);
  std::push_heap(pending_.begin(), pending_.end());
}

void demanded_bits::demand_all(node_id id) { demand(id, APInt::getAllOnes(g_.nodes[id].width)); }

void demanded_bits::pass_on(node_id id) {
  const node& n = g_.nodes[id];
  const APInt bits = nodes_[id];
  const auto width_of = [&](std::size_t i) { return g_.nodes[n.operands[i]].width; };
  switch (n.kind) {
    case operation::add:
    case operation::subtract:
    case operation::multiply:  // a bit depends on the bits up to its own
      for (const node_id operand : n.operands) demand(operand, APInt::getLowBitsSet(n.width, bits.getActiveBits()));
      return;
    case operation::bit_and:
    case operation::bit_or:
      for (std::size_t i = 0; i < 2; ++i) {  // a constant on the other side may decide a bit
        const node& other = g_.nodes[n.operands[1 - i]];
        APInt open = bits;
        if (other.kind == operation::constant) open &= n.kind == operation::bit_and ? other.value : ~other.value;
        demand(n.operands[i], open);
      }
      return;
    case operation::bit_xor:
    case operation::bit_not:
      for (const node_id operand : n.operands) demand(operand, bits);
      return;
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return pass_on_shift(n, bits);
    case operation::select:
      demand_all(n.operands[0]);
      demand(n.operands[1], bits);
      demand(n.operands[2], bits);
      return;
    case operation::concat: {
      unsigned low = n.width;
      for (const node_id operand : n.operands) {
        low -= g_.nodes[operand].width;
        demand(operand, bits.extractBits(g_.nodes[operand].width, low));
      }
      return;
    }
    case operation::slice:
      demand(n.operands[0], bits.zext(width_of(0)).shl(n.low));
      return;
    case operation::extend_zero:
      demand(n.operands[0], bits.trunc(width_of(0)));
      return;
    case operation::extend_sign: {
      APInt kept = bits.trunc(width_of(0));
      if (bits.getActiveBits() > width_of(0)) kept.setSignBit();
      demand(n.operands[0], kept);
      return;
    }
    case operation::register_value:
    case operation::memory_read:
    case operation::table:
      return pass_on_state(n, bits);
    default:  // comparisons, divisions
      for (const node_id operand : n.operands) demand_all(operand);
  }
}

void demanded_bits::pass_on_shift(const node& n, const APInt& bits) {
  demand_all(n.operands[1]);
  if (n.kind == operation::shift_left)
    demand(n.operands[0], APInt::getLowBitsSet(n.width, bits.getActiveBits()));
  else if (n.kind == operation::shift_right_logical)
    demand(n.operands[0], APInt::getBitsSetFrom(n.width, bits.countr_zero()));
  else
    demand_all(n.operands[0]);  // wherever the value's own bits end, its sign is wanted
}

void demanded_bits::pass_on_state(const node& n, const APInt& bits) {
  const auto grows = [&](APInt& known) {
    if (bits.isSubsetOf(known)) return false;
    known |= bits;
    return true;
  };
  if (n.kind == operation::register_value) {
    const register_state& r = g_.registers[n.object];
    if (!grows(registers_[n.object])) return;
    demand(r.next, registers_[n.object]);
    demand_all(r.enable);
    if (r.patient) demand_all(g_.patient);
    return;
  }
  for (std::size_t i = 0; i < n.operands.size(); ++i) demand_all(n.operands[i]);
  if (n.kind == operation::table) {
    grows(tables_[n.object]);
    return;
  }
  if (!grows(memories_[n.object])) return;
  for (const node_id id : writes_[n.object]) {
    const node& write = g_.nodes[id];
    demand_all(write.operands[0]);
    demand(write.operands[1], memories_[n.object]);
    demand_all(write.operands[2]);
  }
}

}  // namespace epiline::passes
