#include "passes/remove_dead.hpp"

#include <vector>

namespace epiline::passes {

using namespace dataflow;

namespace {

/// Marks what is used, from the effects back to their sources; a register or memory is used when its value is read.
class marker {
 public:
  explicit marker(const graph& g)
      : node_used(g.nodes.size()),
        register_used(g.registers.size()),
        memory_used(g.memories.size()),
        table_used(g.tables.size()),
        g_(g),
        writes_(g.memories.size()) {
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const node& n = g.nodes[id];
      if (n.kind == operation::memory_write) writes_[n.object].push_back(id);
      if (n.kind == operation::read || n.kind == operation::write) use(id);
    }
    while (!pending_.empty()) {
      const node_id id = pending_.back();
      pending_.pop_back();
      visit(g.nodes[id]);
    }
  }

  std::vector<char> node_used, register_used, memory_used, table_used;
  bool patient_used = false;

 private:
  void use(node_id id) {
    if (node_used[id]) return;
    node_used[id] = 1;
    pending_.push_back(id);
  }

  void visit(const node& n) {
    for (const node_id operand : n.operands) use(operand);
    if (n.kind == operation::table) table_used[n.object] = 1;
    if (n.kind == operation::register_value && !register_used[n.object]) {
      const register_state& r = g_.registers[n.object];
      register_used[n.object] = 1;
      use(r.next);
      use(r.enable);
      if (r.patient) {
        patient_used = true;
        use(g_.patient);
      }
    }
    if (n.kind == operation::memory_read && !memory_used[n.object]) {
      memory_used[n.object] = 1;
      for (const node_id write : writes_[n.object]) use(write);
    }
  }

  const graph& g_;
  std::vector<std::vector<node_id>> writes_;  // of each memory
  std::vector<node_id> pending_;
};

/// Keeps the used objects of a list and gives their new ids.
template <class Object>
std::vector<std::uint32_t> keep_used(std::vector<Object>& objects, const std::vector<char>& used) {
  std::vector<std::uint32_t> new_id(objects.size(), none);
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (!used[i]) continue;
    if (kept != i) objects[kept] = std::move(objects[i]);
    new_id[i] = kept++;
  }
  objects.resize(kept);
  return new_id;
}

}  // namespace

void remove_dead(graph& g) {
  const marker marks(g);
  const auto new_register = keep_used(g.registers, marks.register_used);
  const auto new_memory = keep_used(g.memories, marks.memory_used);
  const auto new_table = keep_used(g.tables, marks.table_used);
  const auto new_node = keep_used(g.nodes, marks.node_used);
  for (node& n : g.nodes) {
    for (node_id& operand : n.operands) operand = new_node[operand];
    if (n.kind == operation::register_value) n.object = new_register[n.object];
    if (n.kind == operation::memory_read || n.kind == operation::memory_write) n.object = new_memory[n.object];
    if (n.kind == operation::table) n.object = new_table[n.object];
  }
  for (register_state& r : g.registers) {
    r.next = new_node[r.next];
    r.enable = new_node[r.enable];
  }
  g.patient = marks.patient_used ? new_node[g.patient] : none;
}

}  // namespace epiline::passes
