#pragma once
// What the clock period asks of the stages: chains of operations that are too long for it are cut, and long wires get a
// clock of their own.

#include <cstdint>
#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/constraint_system.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/fan_out.hpp"
#include "schedule/problem.hpp"
#include "schedule/schedule.hpp"

namespace epiline::schedule {

class chains {
 public:
  chains(const dataflow::graph& g, const delay_model& model, const problem& p);

  /// At `period`, a chain that starts with node u may not reach v in the same stage. Returns `none`, or the node that
  /// alone takes longer than the period.
  /// Chains between different `component`s, which no recurrence holds together, get `calm` only instead of `period`.
  [[nodiscard]] dataflow::node_id add_chains(double period, double calm, const std::vector<std::uint32_t>& component,
                                             std::vector<constraint>& constraints) const;

  /// Long ways, outside recurrences, get a clock of their own: values wait in a flip-flop before anything is computed
  /// from them. What very many read has a way as long as the design is wide to its readers' copies of it; tokens come
  /// from the pins; the words of a memory of many block RAMs from all over the device.
  void add_distribution(const std::vector<std::uint32_t>& component, std::vector<constraint>& constraints) const;

  /// Appends the slowest way from node `from` to the variable `to`; its delay in nanoseconds from clock to clock.
  double trace(dataflow::node_id from, variable to, std::vector<chain_link>& chain) const;

 private:
  /// A combinational way out of a node: into another node, or into something that ends the stage.
  struct way {
    variable to = 0;
    double entry = 0;   // nanoseconds before the target's own delay
    double spread = 0;  // and what it costs more because the value has many readers
  };

  void collect_ways();
  [[nodiscard]] int stages_to_readers(dataflow::node_id id) const;

  const dataflow::graph& g_;
  const delay_model& model_;
  const problem& p_;
  const std::vector<char>& settled_;
  std::vector<double> delay_;  // per node, nanoseconds
  spread spread_;
  std::vector<std::vector<way>> ways_;  // per node
};

}  // namespace epiline::schedule
