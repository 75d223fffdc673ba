#pragma once
// The registers of a graph: which values share one, and one for each place where a step can start.

#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/graph_nodes.hpp"
#include "frontend/live_values.hpp"
#include "frontend/machine_start.hpp"

namespace epiline::frontend {

class step_registers {
 public:
  /// Adds the registers and the nodes that read them to the graph; what they hold next is not known yet.
  step_registers(const step_structure& steps, const step_flow& flow, const live_values& live,
                 const machine_start& start, graph_nodes& nodes, dataflow::graph& graph);

  /// Whether the value lies in a register when some step starts.
  [[nodiscard]] bool has(const llvm::Instruction* value) const { return register_of_.count(value) != 0; }
  [[nodiscard]] dataflow::register_id of(const llvm::Instruction* value) const { return register_of_.at(value); }

  /// What a register holds during a step.
  [[nodiscard]] dataflow::node_id value(dataflow::register_id id) const { return values_[id]; }

  /// 1 in the steps that start at the cut.
  [[nodiscard]] dataflow::node_id at_cut(unsigned cut) const { return at_cut_[cut]; }

  /// Cuts with the registers that are 1 there; none when all steps start at the same place.
  [[nodiscard]] const std::vector<std::pair<unsigned, dataflow::register_id>>& states() const { return states_; }

 private:
  using alive_at = std::map<const llvm::Instruction*, std::set<unsigned>>;  // values, with the cuts

  void assign(const alive_at& alive, const step_flow& flow);
  void make_states();
  dataflow::register_id add(dataflow::register_state made);

  const step_structure& steps_;
  const machine_start& start_;
  graph_nodes& nodes_;
  dataflow::graph& graph_;
  std::unordered_map<const llvm::Instruction*, dataflow::register_id> register_of_;
  std::vector<dataflow::node_id> values_;
  std::vector<std::pair<unsigned, dataflow::register_id>> states_;
  std::vector<dataflow::node_id> at_cut_;
};

}  // namespace epiline::frontend
