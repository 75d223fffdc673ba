#pragma once
// What is known about every value before the machine runs: bits that never change and the interval a value stays in,
// also through registers and memories.

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/BitVector.h>
#include <llvm/ADT/SmallVector.h>

#include <vector>

#include "dataflow/graph.hpp"
#include "passes/value_set.hpp"

namespace epiline::passes {

class known_values {
 public:
  /// Unspecified values count as 0, as in the interpreter.
  explicit known_values(const dataflow::graph& g);

  [[nodiscard]] const value_set& of_node(dataflow::node_id id) const { return nodes_[id]; }
  [[nodiscard]] const value_set& of_register(dataflow::register_id id) const { return registers_[id]; }
  [[nodiscard]] const value_set& of_memory(dataflow::memory_id id) const { return memories_[id]; }
  [[nodiscard]] const value_set& of_table(std::uint32_t id) const { return tables_[id]; }

 private:
  struct fact {  // "in this arm, that node lies in this range"
    dataflow::node_id subject;
    llvm::ConstantRange range;
  };
  using fact_list = llvm::SmallVector<fact, 8>;

  void iterate();
  bool grow_state(std::vector<unsigned>& register_changes, std::vector<unsigned>& memory_changes);
  void tighten();
  void evaluate_all();
  void evaluate_changed();
  bool has_changed_state(dataflow::node_id id) const;
  value_set evaluate(dataflow::node_id id) const;
  value_set evaluate_select(const dataflow::node& n) const;
  void add_facts(dataflow::node_id condition, bool holds, unsigned depth, fact_list& facts) const;
  void add_fact(dataflow::node_id subject, llvm::ConstantRange range, unsigned depth, fact_list& facts) const;
  value_set refined(dataflow::node_id id, const fact_list& facts, unsigned depth) const;
  value_set next_of(dataflow::register_id id) const;
  bool is_never(dataflow::node_id bit) const;

  /// The nodes that have a node as their operand, one list behind the other.
  class user_lists {
   public:
    explicit user_lists(const dataflow::graph& g);
    [[nodiscard]] llvm::ArrayRef<dataflow::node_id> of(dataflow::node_id id) const {
      return llvm::ArrayRef(users_).slice(begins_[id], begins_[id + 1] - begins_[id]);
    }

   private:
    std::vector<std::uint32_t> begins_;
    std::vector<dataflow::node_id> users_;
  };

  const dataflow::graph& g_;
  std::vector<value_set> nodes_, registers_, memories_, tables_;
  const user_lists users_;
  std::vector<dataflow::node_id> state_reads_, memory_writes_;
  std::vector<unsigned char> steps_to_change_;  // from each node to what it is made of that changed in this round
  std::vector<dataflow::node_id> reached_;      // nodes that were evaluated in this round
  llvm::BitVector pending_;                     // nodes still to be evaluated in it
  std::vector<char> register_changed_, memory_changed_;
};

}  // namespace epiline::passes
