// The ports and memories that a step accesses: one node for all reads of a port, one for all writes, whatever the way
// through the step.

#include "frontend/step_values.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

using dataflow::node_id;
using dataflow::operation;
using llvm::BasicBlock;
using llvm::Instruction;

void step_values::collect_accesses(const BasicBlock& block) {
  if (!start_.runs(&block)) return;
  for (const Instruction& instruction : block) {
    const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
    switch (access_of(instruction)) {
      case access::read:
        port_accesses_[object_of(instruction)].reads.push_back(call);
        break;
      case access::write:
        port_accesses_[object_of(instruction)].writes.push_back(call);
        break;
      case access::memory_read:
        memory_accesses_[object_of(instruction)].reads.push_back(call);
        break;
      case access::memory_write:
        memory_accesses_[object_of(instruction)].writes.push_back(call);
        break;
      default:
        break;
    }
  }
}

void step_values::read_tokens(unsigned port) {
  const std::vector<const llvm::CallInst*>& reads = port_accesses_[port].reads;
  if (translated_.count(reads.front()) != 0) return;
  node_id wanted = nodes_.bit(false);
  for (const llvm::CallInst* read : reads) wanted = nodes_.either(wanted, predicate(read->getParent()));
  const node_id made =
      nodes_.add(operation::read, graph_.ports[port].width, {wanted}, nodes_.location(place_of(*reads.front())));
  nodes_[made].object = port;
  nodes_[made].name = graph_.ports[port].name;
  for (const llvm::CallInst* read : reads) translated_[read] = made;
}

node_id step_values::memory_read(const llvm::CallInst& at) {
  const unsigned object = object_of(at);
  const node_id address = memory_address(at);
  const node_id enable = predicate(at.getParent());
  const auto [found, is_new] = memory_reads_.try_emplace({object, address, enable}, 0);
  if (is_new) {
    found->second = nodes_.add(operation::memory_read, graph_.memories[object].width, {address, enable},
                               nodes_.location(place_of(at)));
    nodes_[found->second].object = object;
    nodes_[found->second].name = graph_.memories[object].name;
  }
  node_id value = found->second;
  for (const llvm::CallInst* write : memory_accesses_[object].writes) {
    const bool earlier = write->getParent() == at.getParent() ? write->comesBefore(&at)
                                                              : flow_.reaches(write->getParent(), at.getParent());
    if (!earlier) continue;
    const node_id same = nodes_.equal(memory_address(*write), address);
    value =
        nodes_.choose(nodes_.both(write_enable(*write), same), use(write->getArgOperand(2), write->getParent()), value);
  }
  return value;
}

node_id step_values::write_enable(const llvm::CallInst& write) {
  return nodes_.both(predicate(write.getParent()), use(write.getArgOperand(3), write.getParent()));
}

node_id step_values::memory_address(const llvm::CallInst& at) {
  return nodes_.in_address_width(use(at.getArgOperand(1), at.getParent()), graph_.memories[object_of(at)].words);
}

void step_values::build_effects() {
  for (auto& [port, accesses] : port_accesses_) {
    if (!accesses.reads.empty()) read_tokens(port);
    if (!accesses.writes.empty()) build_write(port, accesses.writes);
  }
  for (auto& [object, accesses] : memory_accesses_) {
    if (!accesses.writes.empty()) build_memory_write(object, accesses.writes);
  }
  if (steps_.patient_cut >= 0 && start_.runs(static_cast<unsigned>(steps_.patient_cut)))
    graph_.patient = registers_.at_cut(static_cast<unsigned>(steps_.patient_cut));
}

void step_values::build_write(unsigned port, const std::vector<const llvm::CallInst*>& writes) {
  node_id enable = nodes_.bit(false);
  node_id token = dataflow::none;
  for (const llvm::CallInst* write : writes) {
    const node_id here = predicate(write->getParent());
    const node_id value = use(write->getArgOperand(1), write->getParent());
    token = token == dataflow::none ? value : nodes_.choose(here, value, token);
    enable = nodes_.either(enable, here);
  }
  const node_id made = nodes_.add(operation::write, 0, {enable, token}, nodes_.location(place_of(*writes.front())));
  nodes_[made].object = port;
  nodes_[made].name = graph_.ports[port].name;
}

void step_values::build_memory_write(unsigned object, const std::vector<const llvm::CallInst*>& writes) {
  node_id enable = nodes_.bit(false);
  node_id address = dataflow::none;
  node_id data = dataflow::none;
  for (const llvm::CallInst* write : writes) {
    const node_id here = write_enable(*write);
    const node_id this_address = memory_address(*write);
    const node_id this_data = use(write->getArgOperand(2), write->getParent());
    address = address == dataflow::none ? this_address : nodes_.choose(here, this_address, address);
    data = data == dataflow::none ? this_data : nodes_.choose(here, this_data, data);
    enable = nodes_.either(enable, here);
  }
  const node_id made =
      nodes_.add(operation::memory_write, 0, {address, data, enable}, nodes_.location(place_of(*writes.front())));
  nodes_[made].object = object;
  nodes_[made].name = graph_.memories[object].name;
}

}  // namespace epiline::frontend
