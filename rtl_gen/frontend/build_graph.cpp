#include "frontend/build_graph.hpp"

#include <llvm/IR/CFG.h>
#include <llvm/IR/Instructions.h>

#include <set>

#include "frontend/graph_nodes.hpp"
#include "frontend/live_values.hpp"
#include "frontend/machine_start.hpp"
#include "frontend/sort_nodes.hpp"
#include "frontend/step_flow.hpp"
#include "frontend/step_registers.hpp"
#include "frontend/step_values.hpp"
#include "frontend/steps.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

using dataflow::node_id;
using llvm::BasicBlock;
using llvm::Instruction;
using llvm::Value;

class graph_builder {
 public:
  graph_builder(lowered_process& process, dataflow::graph& graph)
      : graph_(graph),
        steps_(cut_into_steps(process)),
        flow_(steps_),
        live_(find_live_values(steps_, flow_)),
        start_(steps_, flow_, live_),
        nodes_(with_objects(process)),
        registers_(steps_, flow_, live_, start_, nodes_, graph_),
        values_(steps_, flow_, start_, registers_, nodes_, graph_) {}

  void build() {
    values_.build_effects();
    build_registers();
    sort_nodes(graph_);
  }

 private:
  /// Gives the graph the ports, memories and tables of the process.
  graph_nodes with_objects(const lowered_process& process) {
    graph_nodes nodes(graph_);
    graph_.ports = process.ports;
    graph_.memories = process.memories;
    graph_.tables = process.tables;
    for (dataflow::port& port : graph_.ports) port.where = nodes.location(process.top_place);
    for (std::size_t i = 0; i < graph_.memories.size(); ++i)
      graph_.memories[i].where = nodes.location(process.memory_places[i]);
    for (std::size_t i = 0; i < graph_.tables.size(); ++i)
      graph_.tables[i].where = nodes.location(process.table_places[i]);
    return nodes;
  }

  void build_registers() {
    std::vector<std::vector<update>> updates(graph_.registers.size());
    const std::vector<std::pair<control_edge, unsigned>> ends = ending_edges();
    for (const auto& [along, cut] : ends)
      for (const Instruction* value : live_[cut]) {
        const dataflow::register_id target = registers_.of(value);
        const Value* incoming = value;
        if (steps_.is_cut_phi(value) && value->getParent() == along.to)
          incoming = llvm::cast<llvm::PHINode>(value)->getIncomingValueForBlock(along.from);
        add_updates(updates[target], target, incoming, along);
      }
    for (const auto& [cut, target] : registers_.states()) {
      node_id entered = nodes_.bit(false);
      for (const auto& [along, to] : ends)
        if (to == cut) entered = nodes_.either(entered, values_.edge_predicate(along));
      updates[target].push_back({entered, nodes_.bit(true), false});
    }
    set_initial_values();
    for (dataflow::register_id i = 0; i < updates.size(); ++i) finish_register(i, updates[i]);
  }

  /// One way a register gets a new value: on these edges (a predicate), this value.
  struct update {
    node_id value;
    node_id when;
    bool patient;  // only in steps that start at the patient cut
  };

  /// The edges that end a step, with the cut they lead to.
  std::vector<std::pair<control_edge, unsigned>> ending_edges() const {
    std::vector<std::pair<control_edge, unsigned>> edges;
    for (const BasicBlock* block : steps_.order) {
      if (!start_.runs(block)) continue;
      std::set<const BasicBlock*> seen;
      for (const BasicBlock* next : llvm::successors(block))
        if (steps_.is_cut(next) && seen.insert(next).second && !is_impossible(next))
          edges.push_back({control_edge{block, next}, steps_.cut_number.at(next)});
    }
    return edges;
  }

  /// On this edge the register takes `incoming`. A value that only merges others is taken apart by the edges it comes
  /// along: where it is the register's own value, nothing is to be done.
  void add_updates(std::vector<update>& updates, dataflow::register_id target, const Value* incoming,
                   const control_edge& along) {
    if (llvm::isa<llvm::UndefValue>(incoming)) return;
    // State that a reset leaves alone, handed on by a step that runs after each reset: the register begins with it, and
    // the step leaves it as it is.
    if (const llvm::Constant* number = power_up_value(incoming)) {
      begin_with(target, {const_cast<llvm::Constant*>(number), true});
      return;
    }
    const auto* merge = llvm::dyn_cast<llvm::PHINode>(incoming);
    if (merge != nullptr && merge->getParent() == along.from && !steps_.is_cut_phi(merge) &&
        along.from->getSingleSuccessor() != nullptr) {
      for (const BasicBlock* before : flow_.predecessors(along.from))
        if (start_.runs(before))
          add_updates(updates, target, merge->getIncomingValueForBlock(before), {before, along.from});
      return;
    }
    const node_id next = values_.use(incoming, along.from);
    if (next == registers_.value(target)) return;
    const node_id when = values_.edge_predicate(along);
    const bool patient = start_.only_in_patient_steps(along.from);
    for (update& known : updates)
      if (known.value == next) {
        known.when = nodes_.either(known.when, when);
        known.patient = known.patient && patient;
        return;
      }
    updates.push_back({next, when, patient});
  }

  void finish_register(dataflow::register_id id, const std::vector<update>& updates) {
    dataflow::register_state& state = graph_.registers[id];
    if (updates.empty()) {
      state.next = registers_.value(id);
      state.enable = nodes_.bit(false);
      return;
    }
    node_id next = updates.front().value;
    node_id enable = updates.front().when;
    bool patient = updates.front().patient;
    for (std::size_t i = 1; i < updates.size(); ++i) {
      next = nodes_.choose(updates[i].when, updates[i].value, next);
      enable = nodes_.either(enable, updates[i].when);
      patient = patient && updates[i].patient;
    }
    state.next = next;
    state.enable = enable;
    state.patient = patient;
  }

  /// What the registers hold when the first step starts.
  void set_initial_values() {
    if (!start_.is_folded()) return;
    std::vector<const Instruction*> values;
    const BasicBlock* const first = start_.first();
    for (const llvm::PHINode& phi : first->phis()) values.push_back(&phi);
    for (const Instruction* value : live_[steps_.cut_number.at(first)])
      if (!steps_.is_cut_phi(value) || value->getParent() != first) values.push_back(value);
    for (const Instruction* instruction : values) {
      if (!registers_.has(instruction)) continue;
      begin_with(registers_.of(instruction), start_.value_of(instruction));
    }
  }

  void begin_with(dataflow::register_id id, const start_value& value) {
    dataflow::register_state& state = graph_.registers[id];
    if (value.is_kept_at_reset) state.resets = false;
    if (const auto* number = llvm::dyn_cast_or_null<llvm::ConstantInt>(value.number))
      state.initial = number->getValue();
  }

  dataflow::graph& graph_;
  step_structure steps_;
  step_flow flow_;
  live_values live_;
  machine_start start_;
  graph_nodes nodes_;
  step_registers registers_;
  step_values values_;
};

}  // namespace

dataflow::graph build_graph(lowered_process& process, const std::string& name) {
  dataflow::graph graph;
  graph.name = name;
  graph_builder(process, graph).build();
  return graph;
}

}  // namespace epiline::frontend
