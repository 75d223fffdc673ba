#include "frontend/step_values.hpp"

#include <fmt/format.h>

namespace epiline::frontend {

using dataflow::node_id;
using dataflow::operation;
using llvm::BasicBlock;
using llvm::Instruction;
using llvm::Value;

step_values::step_values(const step_structure& steps, const step_flow& flow, const machine_start& start,
                         const step_registers& registers, graph_nodes& nodes, dataflow::graph& graph)
    : steps_(steps), flow_(flow), start_(start), registers_(registers), nodes_(nodes), graph_(graph) {
  for (const BasicBlock* block : steps_.order) collect_accesses(*block);
}

node_id step_values::use(const Value* value, const BasicBlock* at) {
  if (const auto* number = llvm::dyn_cast<llvm::ConstantInt>(value)) return nodes_.constant(number->getValue());
  if (llvm::isa<llvm::UndefValue>(value)) return nodes_.constant(value->getType()->getIntegerBitWidth(), 0);
  const auto* instruction = llvm::dyn_cast<Instruction>(value);
  if (instruction == nullptr)
    refuse({}, fmt::format("internal: a value of kind {} reached the dataflow graph", value->getValueID()));
  if (steps_.is_cut_phi(instruction)) return register_value(instruction);
  const BasicBlock* home = instruction->getParent();
  if (home == at || (flow_.reaches(home, at) && flow_.dominates(home, at))) return node_of(*instruction);
  if (!flow_.reaches(home, at)) return register_value(instruction);
  // Some steps come through its definition, others need what an earlier step left.
  const auto key = std::make_pair(instruction, at);
  if (const auto found = mixed_.find(key); found != mixed_.end()) return found->second;
  const node_id chosen = nodes_.choose(predicate(home), node_of(*instruction), register_value(instruction));
  mixed_[key] = chosen;
  return chosen;
}

node_id step_values::node_of(const Instruction& instruction) {
  if (const auto found = translated_.find(&instruction); found != translated_.end()) return found->second;
  const node_id made = translate(instruction);
  translated_[&instruction] = made;
  if (dataflow::node& n = nodes_[made]; n.kind != operation::constant && n.kind != operation::register_value) {
    if (n.where.line == 0) n.where = nodes_.location(place_of(instruction.getDebugLoc()));
    if (n.name.empty()) n.name = readable_name(instruction);
  }
  return made;
}

node_id step_values::register_value(const Instruction* value) {
  if (!registers_.has(value))  // never computed before a running step needs it
    return nodes_.constant(value->getType()->getIntegerBitWidth(), 0);
  return registers_.value(registers_.of(value));
}

node_id step_values::predicate(const BasicBlock* block, const BasicBlock* root) {
  if (block == root) return nodes_.bit(true);
  const auto key = std::make_pair(block, root);
  if (const auto found = block_predicates_.find(key); found != block_predicates_.end()) return found->second;
  node_id result = nodes_.bit(false);
  if (steps_.is_cut(block)) {
    result = root != nullptr ? nodes_.bit(false) : registers_.at_cut(steps_.cut_number.at(block));
  } else if (const BasicBlock* twin = flow_.always_with(block);
             twin != nullptr && (root == nullptr || flow_.dominates(root, twin))) {
    result = predicate(twin, root);
  } else {
    for (const BasicBlock* before : flow_.predecessors(block))
      if (root == nullptr || before == root || flow_.reaches(root, before))
        result = nodes_.either(result, edge_predicate({before, block}, root));
  }
  block_predicates_[key] = result;
  return result;
}

node_id step_values::edge_predicate(const control_edge& along, const BasicBlock* root) {
  const auto key = std::make_pair(along, root);
  if (const auto found = edge_predicates_.find(key); found != edge_predicates_.end()) return found->second;
  node_id taken = nodes_.bit(true);
  const Instruction* end = along.from->getTerminator();
  if (const auto* branch = llvm::dyn_cast<llvm::BranchInst>(end)) {
    if (branch->isConditional() && branch->getSuccessor(0) != branch->getSuccessor(1) &&
        !is_impossible(branch->getSuccessor(0)) && !is_impossible(branch->getSuccessor(1))) {
      const node_id condition = use(branch->getCondition(), along.from);
      taken = branch->getSuccessor(0) == along.to ? condition : nodes_.inverse(condition);
    }
  } else if (const auto* choice = llvm::dyn_cast<llvm::SwitchInst>(end)) {
    taken = switch_edge(*choice, along);
  }
  const node_id result = nodes_.both(predicate(along.from, root), taken);
  edge_predicates_[key] = result;
  return result;
}

node_id step_values::switch_edge(const llvm::SwitchInst& choice, const control_edge& along) {
  const node_id value = use(choice.getCondition(), along.from);
  node_id cases = nodes_.bit(false);
  node_id elsewhere = nodes_.bit(false);
  for (const auto& one : choice.cases()) {
    const node_id here = nodes_.equal(value, nodes_.constant(one.getCaseValue()->getValue()));
    if (one.getCaseSuccessor() == along.to)
      cases = nodes_.either(cases, here);
    else if (!is_impossible(one.getCaseSuccessor()))
      elsewhere = nodes_.either(elsewhere, here);
  }
  return choice.getDefaultDest() == along.to ? nodes_.inverse(elsewhere) : cases;
}

node_id step_values::join(const llvm::PHINode& phi) {
  const BasicBlock* block = phi.getParent();
  const BasicBlock* root = flow_.dominator(block);
  node_id result = dataflow::none;
  for (unsigned i = phi.getNumIncomingValues(); i-- > 0;) {
    if (llvm::isa<llvm::UndefValue>(phi.getIncomingValue(i))) continue;
    const BasicBlock* from = phi.getIncomingBlock(i);
    if (!flow_.contains(from)) continue;
    const node_id value = use(phi.getIncomingValue(i), from);
    result = result == dataflow::none ? value : nodes_.choose(edge_predicate({from, block}, root), value, result);
  }
  return result == dataflow::none ? nodes_.constant(phi.getType()->getIntegerBitWidth(), 0) : result;
}

}  // namespace epiline::frontend
