#pragma once
// Makes the nodes of a new graph. Every node a pass makes goes through here, so every pass gets for free: constant
// folding, the rewriting rules of rules.hpp, and one node for equal expressions.

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::passes {

using dataflow::graph;
using dataflow::memory_id;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

class builder {
 public:
  /// Appends to `target`, whose nodes must be empty; ports, registers, memories and tables must be there already.
  explicit builder(graph& target);

  /// The node that computes `n`: a new one, an equal earlier one, or what the rules make of it. Operands are ids of the
  /// target. The result has the width of `n` (memory writes and port writes: 0).
  node_id make(node n);
  node_id make(operation kind, unsigned width, std::vector<node_id> operands, unsigned low = 0);

  /// The value of a register of the target.
  node_id register_value(register_id id);
  node_id constant(const llvm::APInt& value);
  node_id constant(unsigned width, std::uint64_t value);
  node_id bit(bool value) { return constant(1, value ? 1 : 0); }

  // Operations whose width follows from their operands'.
  node_id add(node_id a, node_id b) { return make(operation::add, width(a), {a, b}); }
  node_id subtract(node_id a, node_id b) { return make(operation::subtract, width(a), {a, b}); }
  node_id multiply(node_id a, node_id b) { return make(operation::multiply, width(a), {a, b}); }
  node_id bit_and(node_id a, node_id b) { return make(operation::bit_and, width(a), {a, b}); }
  node_id bit_or(node_id a, node_id b) { return make(operation::bit_or, width(a), {a, b}); }
  node_id bit_xor(node_id a, node_id b) { return make(operation::bit_xor, width(a), {a, b}); }
  node_id bit_not(node_id a) { return make(operation::bit_not, width(a), {a}); }
  node_id equal(node_id a, node_id b) { return make(operation::equal, 1, {a, b}); }
  node_id less_unsigned(node_id a, node_id b) { return make(operation::less_unsigned, 1, {a, b}); }
  node_id select(node_id c, node_id a, node_id b) { return make(operation::select, width(a), {c, a, b}); }
  /// condition ? -a : a
  node_id negate_if(node_id condition, node_id a) { return select(condition, subtract(constant(width(a), 0), a), a); }
  /// High part first. One part is returned as it is.
  node_id concat(std::vector<node_id> parts);
  /// Bits [low, low + width); all of `a` is `a`.
  node_id slice(node_id a, unsigned low, unsigned width);
  /// Cuts or widens to a width.
  node_id resize_zero(node_id a, unsigned width);
  node_id resize_sign(node_id a, unsigned width);

  [[nodiscard]] const node& at(node_id id) const { return g_.nodes[id]; }  // until the next node is made
  [[nodiscard]] unsigned width(node_id id) const { return g_.nodes[id].width; }
  [[nodiscard]] operation kind(node_id id) const { return g_.nodes[id].kind; }
  [[nodiscard]] node_id operand(node_id id, std::size_t i) const { return g_.nodes[id].operands[i]; }
  [[nodiscard]] bool is_constant(node_id id) const { return kind(id) == operation::constant; }
  [[nodiscard]] llvm::APInt value(node_id constant_id) const { return g_.nodes[constant_id].value; }
  [[nodiscard]] bool is_zero(node_id id) const { return is_constant(id) && at(id).value.isZero(); }
  [[nodiscard]] bool is_ones(node_id id) const { return is_constant(id) && at(id).value.isAllOnes(); }

  /// New nodes come from this source line from now on.
  void set_origin(dataflow::source_location where) { where_ = where; }
  /// Names a node that has no name yet; constants take none.
  void suggest_name(node_id id, const std::string& name);

  graph& target() { return g_; }

 private:
  node_id append(node n);
  std::uint64_t hash_of(const node& n) const;
  bool same(const node& a, const node& b) const;
  void grow_index();

  graph& g_;
  dataflow::source_location where_;
  std::vector<node_id> index_;                // open addressing over hash_of
  std::vector<std::uint32_t> generations_;    // of each node: writes to its memory before it (memory reads only)
  std::vector<std::uint32_t> writes_so_far_;  // of each memory
  unsigned depth_ = 0;                        // of rules within rules
};

/// Rebuilds `g` node by node: `rewrite(builder, n, id)` gets the old node with its operands already replaced by ids of
/// the new graph, and the old id; it returns the id of what stands for it (`none` for a write that is left out).
/// Registers keep their ids; their next values and enables, and `patient`, follow; `fit_next`, if given, may replace
/// the next value of each register at the end, `finish` may append more. Names and lines are kept. `g` itself changes
/// only when all is done, so callbacks may look at it.
void rebuild(graph& g, const std::function<node_id(builder&, node, node_id)>& rewrite,
             const std::function<node_id(builder&, register_id, node_id)>& fit_next = {},
             const std::function<void(builder&)>& finish = {});

/// Like `rebuild` for passes that also change registers, memories or tables: `g` without its nodes.
[[nodiscard]] graph shell_of(const graph& g);

}  // namespace epiline::passes
