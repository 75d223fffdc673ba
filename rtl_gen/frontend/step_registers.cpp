#include "frontend/step_registers.hpp"

#include <fmt/format.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>

namespace epiline::frontend {

using dataflow::node_id;
using dataflow::operation;
using llvm::Instruction;
using llvm::Value;

step_registers::step_registers(const step_structure& steps, const step_flow& flow, const live_values& live,
                               const machine_start& start, graph_nodes& nodes, dataflow::graph& graph)
    : steps_(steps), start_(start), nodes_(nodes), graph_(graph) {
  alive_at alive;
  for (unsigned cut = 0; cut < live.size(); ++cut)
    if (start.runs(cut))
      for (const Instruction* value : live[cut]) alive[value].insert(cut);
  assign(alive, flow);
  make_states();
}

/// One register can serve several values that are never alive at the same cut: above all the phis of one variable.
void step_registers::assign(const alive_at& alive, const step_flow& flow) {
  std::vector<const Instruction*> values;
  for (const auto& [value, cuts] : alive) values.push_back(value);
  std::sort(values.begin(), values.end(),
            [&](const Instruction* a, const Instruction* b) { return flow.comes_before(a, b); });

  std::map<const Instruction*, const Instruction*> leader;
  alive_at occupied = alive;
  const auto find = [&](const Instruction* value) {
    while (leader.count(value) != 0) value = leader.at(value);
    return value;
  };
  for (const Instruction* value : values) {
    if (!steps_.is_cut_phi(value)) continue;
    for (const Value* incoming : llvm::cast<llvm::PHINode>(value)->incoming_values()) {
      const auto* other = llvm::dyn_cast<Instruction>(incoming);
      if (other == nullptr || alive.count(other) == 0) continue;
      // What a patient step computes keeps a register of its own: only then it has time.
      if (!steps_.is_cut_phi(other) && start_.only_in_patient_steps(other->getParent())) continue;
      const Instruction* a = find(value);
      const Instruction* b = find(other);
      if (a == b) continue;
      const auto& in_a = occupied.at(a);
      if (std::any_of(in_a.begin(), in_a.end(), [&](unsigned cut) { return occupied.at(b).count(cut) != 0; })) continue;
      occupied.at(a).insert(occupied.at(b).begin(), occupied.at(b).end());
      leader[b] = a;
    }
  }
  instruction_places places;
  std::map<const Instruction*, dataflow::register_id> of_leaders;
  for (const Instruction* value : values) {
    const Instruction* first = find(value);
    const auto [found, is_new] = of_leaders.try_emplace(first, 0);
    if (is_new) {
      dataflow::register_state made;
      made.name = readable_name(*first);
      made.width = first->getType()->getIntegerBitWidth();
      made.where = nodes_.location(places.of(*first));
      found->second = add(std::move(made));
    }
    register_of_[value] = found->second;
  }
}

/// One-hot: a bit for each cut.
void step_registers::make_states() {
  std::vector<unsigned> running;
  for (unsigned cut = 0; cut < steps_.cuts.size(); ++cut)
    if (start_.runs(cut)) running.push_back(cut);
  at_cut_.assign(steps_.cuts.size(), nodes_.bit(false));
  if (running.size() < 2) {
    for (const unsigned cut : running) at_cut_[cut] = nodes_.bit(true);
    return;
  }
  for (const unsigned cut : running) {
    dataflow::register_state made;
    made.where = nodes_.location(place_of(*steps_.cuts[cut]->getTerminator()));
    made.name = fmt::format("at_line_{}", made.where.line);
    made.initial = llvm::APInt(1, steps_.cuts[cut] == start_.first() ? 1 : 0);
    states_.emplace_back(cut, add(std::move(made)));
    at_cut_[cut] = values_.back();
  }
}

dataflow::register_id step_registers::add(dataflow::register_state made) {
  const auto id = static_cast<dataflow::register_id>(graph_.registers.size());
  const node_id read = nodes_.add(operation::register_value, made.width, {}, made.where);
  nodes_[read].object = id;
  nodes_[read].name = made.name;
  values_.push_back(read);
  graph_.registers.push_back(std::move(made));
  return id;
}

}  // namespace epiline::frontend
