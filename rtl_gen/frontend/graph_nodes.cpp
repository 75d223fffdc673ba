#include "frontend/graph_nodes.hpp"

#include <llvm/ADT/SmallString.h>
#include <llvm/Support/MathExtras.h>

#include <algorithm>

namespace epiline::frontend {

using dataflow::node_id;
using dataflow::operation;

dataflow::source_location graph_nodes::location(const source_place& place) {
  if (place.line == 0) return {};
  const auto [found, is_new] = file_numbers_.try_emplace(place.file, static_cast<std::uint32_t>(graph_.files.size()));
  if (is_new) graph_.files.push_back(place.file);
  return {found->second, place.line};
}

node_id graph_nodes::add(operation kind, unsigned width, std::vector<node_id> operands,
                         dataflow::source_location where) {
  dataflow::node made;
  made.kind = kind;
  made.width = width;
  made.operands = std::move(operands);
  made.where = where;
  graph_.nodes.push_back(std::move(made));
  return static_cast<node_id>(graph_.nodes.size() - 1);
}

node_id graph_nodes::constant(const llvm::APInt& value) {
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

bool graph_nodes::is_bit(node_id id, bool value) const {
  const dataflow::node& n = graph_.nodes[id];
  return n.kind == operation::constant && n.width == 1 && n.value == (value ? 1u : 0u);
}

node_id graph_nodes::both(node_id a, node_id b) {
  if (is_bit(a, true) || a == b) return b;
  if (is_bit(b, true)) return a;
  if (is_bit(a, false) || is_bit(b, false)) return bit(false);
  return shared(operation::bit_and, a, b);
}

node_id graph_nodes::either(node_id a, node_id b) {
  if (is_bit(a, false) || a == b) return b;
  if (is_bit(b, false)) return a;
  if (is_bit(a, true) || is_bit(b, true)) return bit(true);
  if (complement(a) == b || complement(b) == a) return bit(true);
  return shared(operation::bit_or, a, b);
}

node_id graph_nodes::inverse(node_id a) {
  if (is_bit(a, true)) return bit(false);
  if (is_bit(a, false)) return bit(true);
  if (const node_id known = complement(a); known != dataflow::none) return known;
  const node_id made = shared(operation::bit_not, a, a);
  complements_[a] = made;
  complements_[made] = a;
  return made;
}

node_id graph_nodes::complement(node_id a) const {
  const auto found = complements_.find(a);
  return found == complements_.end() ? dataflow::none : found->second;
}

node_id graph_nodes::shared(operation kind, node_id a, node_id b) {
  if (b < a) std::swap(a, b);
  const auto [found, is_new] = predicates_.try_emplace({static_cast<unsigned>(kind), a, b}, 0);
  if (is_new) found->second = kind == operation::bit_not ? add(kind, 1, {a}) : add(kind, 1, {a, b});
  return found->second;
}

node_id graph_nodes::choose(node_id condition, node_id one, node_id zero) {
  if (one == zero || is_bit(condition, true)) return one;
  if (is_bit(condition, false)) return zero;
  return add(operation::select, graph_.nodes[one].width, {condition, one, zero}, graph_.nodes[one].where);
}

node_id graph_nodes::bits_of(node_id a, unsigned low, unsigned width) {
  const node_id made = add(operation::slice, width, {a});
  graph_.nodes[made].low = low;
  return made;
}

node_id graph_nodes::in_address_width(node_id wide, std::uint64_t words) {
  const unsigned width = std::max(1u, llvm::Log2_64_Ceil(words));
  const auto [found, is_new] = addresses_.try_emplace({wide, width}, 0);
  if (is_new) found->second = graph_.nodes[wide].width > width ? bits_of(wide, 0, width) : wide;
  return found->second;
}

node_id graph_nodes::permuted(node_id a, unsigned width, unsigned group) {
  std::vector<node_id> parts;
  for (unsigned low = 0; low < width; low += group) parts.push_back(bits_of(a, low, group));
  return parts.size() == 1 ? a : add(operation::concat, width, parts);
}

node_id graph_nodes::population_count(node_id a, unsigned width) {
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

node_id graph_nodes::trailing_zeros(node_id a, unsigned width) {
  node_id count = constant(width, width);
  for (unsigned i = width; i-- > 0;) count = choose(width == 1 ? a : bits_of(a, i, 1), constant(width, i), count);
  return count;
}

}  // namespace epiline::frontend
