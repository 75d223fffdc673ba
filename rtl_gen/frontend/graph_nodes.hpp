#pragma once
// Makes the nodes of a graph: constants and predicates once each, and what is not worth a node not at all.

#include <llvm/ADT/APInt.h>

#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

class graph_nodes {
 public:
  using node_id = dataflow::node_id;
  using operation = dataflow::operation;

  explicit graph_nodes(dataflow::graph& graph) : graph_(graph) {}

  dataflow::source_location location(const source_place& place);

  node_id add(operation kind, unsigned width, std::vector<node_id> operands, dataflow::source_location where = {});
  dataflow::node& operator[](node_id id) { return graph_.nodes[id]; }

  node_id constant(const llvm::APInt& value);
  node_id constant(unsigned width, std::uint64_t value) { return constant(llvm::APInt(width, value)); }
  node_id bit(bool value) { return constant(1, value ? 1 : 0); }

  // Of predicates, one bit wide.
  node_id both(node_id a, node_id b);
  node_id either(node_id a, node_id b);
  node_id inverse(node_id a);

  node_id equal(node_id a, node_id b) { return shared(operation::equal, a, b); }
  node_id choose(node_id condition, node_id one, node_id zero);

  // Of the bits of a value.
  node_id bits_of(node_id a, unsigned low, unsigned width);
  /// An index in as many bits as so many words need: C++ indexes with 64.
  node_id in_address_width(node_id wide, std::uint64_t words);
  /// Groups of `group` bits in reverse order.
  node_id permuted(node_id a, unsigned width, unsigned group);
  node_id population_count(node_id a, unsigned width);
  /// Zeros below the lowest one; `width` when there is none.
  node_id trailing_zeros(node_id a, unsigned width);

 private:
  [[nodiscard]] bool is_bit(node_id id, bool value) const;
  [[nodiscard]] node_id complement(node_id a) const;
  /// One node for one predicate expression.
  node_id shared(operation kind, node_id a, node_id b);

  dataflow::graph& graph_;
  std::map<std::string, std::uint32_t> file_numbers_;
  std::map<std::pair<unsigned, std::string>, node_id> constants_;
  std::map<std::tuple<unsigned, node_id, node_id>, node_id> predicates_;
  std::unordered_map<node_id, node_id> complements_;
  std::map<std::pair<node_id, unsigned>, node_id> addresses_;
};

}  // namespace epiline::frontend
