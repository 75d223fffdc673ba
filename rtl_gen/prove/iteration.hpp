#pragma once
// One iteration of a dataflow graph (dataflow/graph.hpp) as terms of an SMT solver: from the state and the tokens it
// starts with to what it takes, gives and leaves behind.

#include <z3++.h>

#include <functional>
#include <optional>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::prove {

/// Bits of a memory's word numbers.
[[nodiscard]] unsigned index_width(unsigned words);

/// The word number of an address, and whether the memory or table has such a word (a truth value).
struct word_place {
  z3::expr index, inside;
};
[[nodiscard]] word_place place_of(const z3::expr& address, unsigned words);

/// A write to a memory: it takes place if `hits` (a truth value), to word `index` (index_width bits).
struct word_write {
  z3::expr hits, index, data;
};

/// What an iteration starts from.
struct start_state {
  std::vector<z3::expr> registers;  // by register
  std::vector<z3::expr> tokens;     // by port; of output ports: anything
  /// Word of a memory with all earlier writes in it.
  std::function<z3::expr(dataflow::memory_id, const z3::expr& index)> word;
  /// What a memory answers instead for a word written in one of the last `distance - 1` iterations.
  std::function<z3::expr(dataflow::memory_id, const z3::expr& index)> stale_word;
  /// Those writes, the latest first; empty for memories of distance 1 and for distances the source promises: a source
  /// that keeps its promise reads no such word.
  std::vector<std::vector<word_write>> recent_writes;  // by memory
  /// Word of a table at an index within it.
  std::function<z3::expr(std::uint32_t table, const z3::expr& index)> table_word;
};

class iteration {
 public:
  /// May replace the term of a node by an equal one.
  using replacement = std::function<std::optional<z3::expr>(dataflow::node_id, const z3::expr&)>;

  /// Both must outlive the object.
  iteration(z3::context& solver, const dataflow::graph& g, const start_state& start, const replacement& replace = {});

  /// Value of a node that has one.
  [[nodiscard]] const z3::expr& node(dataflow::node_id id) const { return nodes_[id]; }
  /// Whether the iteration takes a token from an input port, or gives one to an output port (a truth value).
  [[nodiscard]] z3::expr accesses(dataflow::port_id port) const;
  /// The token given to an output port that is accessed somewhere; all zero for others.
  [[nodiscard]] z3::expr token(dataflow::port_id port) const;
  /// A register's value after the iteration.
  [[nodiscard]] z3::expr register_after(dataflow::register_id id) const;
  /// A memory's word after the iteration.
  [[nodiscard]] z3::expr word_after(dataflow::memory_id id, const z3::expr& index) const;
  /// The iteration's writes to a memory, in order.
  [[nodiscard]] const std::vector<word_write>& writes(dataflow::memory_id id) const { return writes_[id]; }

 private:
  z3::expr term_of(const dataflow::node& n);
  z3::expr read_word(const dataflow::node& n);
  z3::expr shifted(const dataflow::node& n);
  z3::expr pure(const dataflow::node& n);
  const z3::expr& operand(const dataflow::node& n, std::size_t i) const { return nodes_[n.operands[i]]; }

  z3::context& solver_;
  const dataflow::graph& g_;
  const start_state& start_;
  std::vector<z3::expr> nodes_;
  std::vector<std::vector<word_write>> writes_;  // by memory
  std::vector<dataflow::node_id> access_;        // by port, or none
};

}  // namespace epiline::prove
