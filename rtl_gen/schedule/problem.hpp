#pragma once
// What a graph asks of its stages, but for the clock period: which variables there are, and the rules that hold at any
// period. The period's are chains.hpp's.

#include <cstdint>
#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/constraint_system.hpp"
#include "schedule/delay_model.hpp"

namespace epiline::schedule {

/// Registers that change only while no iteration is in flight.
[[nodiscard]] bool is_patient(const dataflow::graph& g, dataflow::register_id r);

/// The variables: the origin, every node's stage, every register's stage and the stage of its update, the end of the
/// pipeline; and the rules between them.
class problem {
 public:
  problem(const dataflow::graph& g, const delay_model& model);

  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// Per node: whether its value is settled (schedule.hpp). It has no constraints then.
  [[nodiscard]] const std::vector<char>& is_settled() const { return settled_; }
  /// Stages from the one where a node works to the first that can use its result.
  [[nodiscard]] int latency(dataflow::node_id id) const { return latency_[id]; }
  [[nodiscard]] static variable of_node(dataflow::node_id id) { return 1 + id; }
  [[nodiscard]] variable of_register(dataflow::register_id r) const { return first_register_ + r; }
  [[nodiscard]] variable of_update(dataflow::register_id r) const { return first_update_ + r; }
  [[nodiscard]] variable end() const { return end_; }
  /// The node a variable stands for, `none` for registers' own variables and the origin.
  [[nodiscard]] dataflow::node_id node_of(variable v) const {
    return v >= 1 && v < first_register_ ? v - 1 : dataflow::none;
  }
  /// The register whose update a variable stands for, or `none`.
  [[nodiscard]] dataflow::register_id register_of_update(variable v) const {
    return v >= first_update_ && v < end_ ? v - first_update_ : dataflow::none;
  }
  /// Whether a node or an update takes part in deciding that an iteration is issued, which is in stage 0.
  [[nodiscard]] bool decides_issue(variable v) const;

  /// All rules but those of the period. `apart`: a memory's writes come a stage after its reads where possible.
  void add_order(int interval, bool apart, std::vector<constraint>& constraints) const;

 private:
  struct memory_accesses {
    std::vector<dataflow::node_id> reads;
    std::vector<dataflow::node_id> writes;
  };

  void collect_accesses();
  void find_issue_cone();
  void add_nodes(std::vector<constraint>& constraints) const;
  void add_registers(int interval, std::vector<constraint>& constraints) const;
  [[nodiscard]] std::vector<int> earliest() const;
  void add_memories(int interval, bool apart, std::vector<constraint>& constraints) const;

  const dataflow::graph& g_;
  std::vector<char> settled_;
  std::vector<int> latency_;
  variable first_register_ = 0;
  variable first_update_ = 0;
  variable end_ = 0;
  std::uint32_t count_ = 0;
  std::vector<memory_accesses> accesses_;
  std::vector<char> in_issue_cone_;     // per node
  std::vector<char> register_in_cone_;  // per register
};

}  // namespace epiline::schedule
