#include "passes/builder.hpp"

#include <algorithm>

#include "dataflow/evaluate.hpp"
#include "passes/rules.hpp"

namespace epiline::passes {

namespace {

// Rules call the builder, which applies rules: bounded, so that a pair of rules undoing each other could only cost
// time.
constexpr unsigned max_rule_depth = 64;

bool is_commutative(operation kind) {
  switch (kind) {
    case operation::add:
    case operation::multiply:
    case operation::bit_and:
    case operation::bit_or:
    case operation::bit_xor:
    case operation::equal:
      return true;
    default:
      return false;
  }
}

/// Nodes of which two equal ones are one.
bool is_shareable(operation kind) {
  return kind != operation::read && kind != operation::write && kind != operation::memory_write;
}

}  // namespace

builder::builder(graph& target) : g_(target), index_(1024, none), writes_so_far_(target.memories.size(), 0) {}

node_id builder::register_value(register_id id) {
  node n;
  n.kind = operation::register_value;
  n.width = g_.registers[id].width;
  n.object = id;
  return make(std::move(n));
}

node_id builder::constant(const llvm::APInt& value) {
  node n;
  n.kind = operation::constant;
  n.width = value.getBitWidth();
  n.value = value;
  return append(std::move(n));
}

node_id builder::constant(unsigned width, std::uint64_t value) {
  return constant(llvm::APInt(64, value).zextOrTrunc(width));
}

node_id builder::make(operation kind, unsigned width, std::vector<node_id> operands, unsigned low) {
  node n;
  n.kind = kind;
  n.width = width;
  n.operands = std::move(operands);
  n.low = low;
  n.where = where_;
  return make(std::move(n));
}

node_id builder::make(node n) {
  if (n.kind == operation::constant || !is_shareable(n.kind)) return append(std::move(n));
  if (is_commutative(n.kind)) {  // constants to the right, otherwise earlier nodes first
    node_id &a = n.operands[0], &b = n.operands[1];
    if (is_constant(a) != is_constant(b) ? is_constant(a) : a > b) std::swap(a, b);
  }
  const auto constant_operand = [&](node_id id) { return is_constant(id); };
  if (dataflow::is_pure(n.kind) && std::all_of(n.operands.begin(), n.operands.end(), constant_operand)) {
    std::vector<llvm::APInt> values;
    for (const node_id operand : n.operands) values.push_back(value(operand));
    return constant(dataflow::evaluate(n.kind, n.width, n.low, values));
  }
  if (n.kind == operation::memory_read && kind(n.operands[0]) == operation::extend_zero)
    n.operands[0] = operand(n.operands[0], 0);
  if (n.kind == operation::memory_read && is_zero(n.operands[1])) return constant(n.width, 0);
  if (depth_ < max_rule_depth) {
    ++depth_;
    const node_id simpler = apply_rules(*this, n);
    --depth_;
    if (simpler != none) return simpler;
  }
  return append(std::move(n));
}

node_id builder::concat(std::vector<node_id> parts) {
  if (parts.size() == 1) return parts[0];
  unsigned sum = 0;
  for (const node_id part : parts) sum += width(part);
  return make(operation::concat, sum, std::move(parts));
}

node_id builder::slice(node_id a, unsigned low, unsigned width) {
  return low == 0 && width == this->width(a) ? a : make(operation::slice, width, {a}, low);
}

node_id builder::resize_zero(node_id a, unsigned width) {
  return width <= this->width(a) ? slice(a, 0, width) : make(operation::extend_zero, width, {a});
}

node_id builder::resize_sign(node_id a, unsigned width) {
  return width <= this->width(a) ? slice(a, 0, width) : make(operation::extend_sign, width, {a});
}

void builder::suggest_name(node_id id, const std::string& name) {
  if (!is_constant(id) && at(id).name.empty()) g_.nodes[id].name = name;
}

std::uint64_t builder::hash_of(const node& n) const {
  std::uint64_t hash = static_cast<std::uint64_t>(n.kind) << 32 | n.width;
  const auto mix = [&hash](std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  };
  mix(std::uint64_t{n.object} << 32 | n.low);
  for (const node_id operand : n.operands) mix(operand);
  if (n.kind == operation::constant)
    for (unsigned i = 0; i < n.value.getNumWords(); ++i) mix(n.value.getRawData()[i]);
  return hash;
}

bool builder::same(const node& a, const node& b) const {
  return a.kind == b.kind && a.width == b.width && a.object == b.object && a.low == b.low && a.operands == b.operands &&
         (a.kind != operation::constant || a.value == b.value);
}

node_id builder::append(node n) {
  if (n.kind == operation::memory_write) ++writes_so_far_[n.object];
  const std::uint32_t generation = n.kind == operation::memory_read ? writes_so_far_[n.object] : 0;
  if (n.where.line == 0) n.where = where_;
  const auto id = static_cast<node_id>(g_.nodes.size());
  if (is_shareable(n.kind)) {
    if ((g_.nodes.size() + 1) * 2 > index_.size()) grow_index();
    std::size_t slot = hash_of(n) & (index_.size() - 1);
    for (; index_[slot] != none; slot = (slot + 1) & (index_.size() - 1)) {
      const node_id earlier = index_[slot];
      if (same(g_.nodes[earlier], n) && generations_[earlier] == generation) return earlier;
    }
    index_[slot] = id;
  }
  generations_.push_back(generation);
  g_.nodes.push_back(std::move(n));
  return id;
}

void builder::grow_index() {
  index_.assign(index_.size() * 4, none);
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (!is_shareable(g_.nodes[id].kind)) continue;
    std::size_t slot = hash_of(g_.nodes[id]) & (index_.size() - 1);
    while (index_[slot] != none) slot = (slot + 1) & (index_.size() - 1);
    index_[slot] = id;
  }
}

graph shell_of(const graph& g) {
  graph shell;
  shell.name = g.name;
  shell.files = g.files;
  shell.ports = g.ports;
  shell.registers = g.registers;
  shell.memories = g.memories;
  shell.tables = g.tables;
  return shell;
}

void rebuild(graph& g, const std::function<node_id(builder&, node, node_id)>& rewrite,
             const std::function<node_id(builder&, register_id, node_id)>& fit_next,
             const std::function<void(builder&)>& finish) {
  graph result = shell_of(g);
  result.nodes.reserve(g.nodes.size() + g.nodes.size() / 4);
  builder b(result);
  std::vector<node_id> replacement(g.nodes.size(), none);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    node n = g.nodes[id];
    const std::string name = std::move(n.name);
    n.name.clear();
    for (node_id& operand : n.operands) {
      operand = replacement[operand];
      // What came without a line (made by the C++ compiler's own optimiser) is shown where its operands are.
      if (n.where.line == 0 && !b.is_constant(operand)) n.where = b.at(operand).where;
    }
    b.set_origin(n.where);
    const auto first_new = static_cast<node_id>(result.nodes.size());
    replacement[id] = rewrite(b, std::move(n), id);
    if (name.empty() || replacement[id] == none) continue;
    b.suggest_name(replacement[id], name);
    // Extensions tend to vanish; what was extended is the value people know.
    node_id kept = replacement[id];
    while (kept >= first_new && (b.kind(kept) == operation::extend_zero || b.kind(kept) == operation::extend_sign))
      kept = b.operand(kept, 0);
    if (kept >= first_new) b.suggest_name(kept, name);
  }
  for (register_id r = 0; r < result.registers.size(); ++r) {
    auto& state = result.registers[r];
    b.set_origin(state.where);
    state.next = replacement[state.next];
    if (fit_next) state.next = fit_next(b, r, state.next);
    state.enable = replacement[state.enable];
  }
  if (finish) finish(b);
  result.patient = g.patient == none ? none : replacement[g.patient];
  g = std::move(result);
}

}  // namespace epiline::passes
