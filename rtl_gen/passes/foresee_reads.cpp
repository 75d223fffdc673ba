#include "passes/foresee_reads.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "passes/builder.hpp"

namespace epiline::passes {

namespace {

/// More operations than these would make the iteration's own recurrence longer than what is saved.
constexpr std::size_t most_operations = 6;

/// What a predicate is computed with, operands first; nothing if anything but gates and registers takes part.
std::optional<std::vector<node_id>> gates_of(const graph& g, node_id predicate) {
  std::vector<char> needed(g.nodes.size(), 0);
  needed[predicate] = 1;
  std::vector<node_id> found;
  std::size_t operations = 0;
  for (node_id id = predicate + 1; id-- > 0;) {
    if (!needed[id]) continue;
    const node& n = g.nodes[id];
    found.push_back(id);
    switch (n.kind) {
      case operation::constant:
        continue;
      case operation::register_value:
        if (g.registers[n.object].patient) return std::nullopt;
        continue;
      case operation::bit_and:
      case operation::bit_or:
      case operation::bit_xor:
      case operation::bit_not:
      case operation::select:
        if (n.width > 1 || ++operations > most_operations) return std::nullopt;
        break;
      default:
        return std::nullopt;
    }
    for (const node_id operand : n.operands) needed[operand] = 1;
  }
  return std::vector<node_id>(found.rbegin(), found.rend());
}

/// The value of a predicate where registers have the values that `value_of` gives, in the graph that `b` makes.
template <class ValueOf>
node_id predicate_of(builder& b, const graph& g, const std::vector<node_id>& gates, const ValueOf& value_of) {
  std::map<node_id, node_id> made;
  for (const node_id id : gates) {
    node n = g.nodes[id];
    for (node_id& operand : n.operands) operand = made.at(operand);
    made[id] = n.kind == operation::register_value ? value_of(n) : b.make(std::move(n));
  }
  return made.at(gates.back());
}

/// The predicate right after a reset, if it does not depend on what a reset leaves open.
std::optional<llvm::APInt> initial_value(const graph& g, const std::vector<node_id>& gates) {
  graph alone = shell_of(g);
  builder b(alone);
  const node_id result = predicate_of(b, g, gates, [&](const node& n) {
    const dataflow::register_state& r = g.registers[n.object];
    return r.initial && r.resets ? b.constant(*r.initial) : b.make(n);
  });
  if (!b.is_constant(result)) return std::nullopt;
  return b.value(result);
}

struct foreseen {
  std::vector<node_id> gates;
  register_id state;
};

}  // namespace

bool foresee_reads(graph& g) {
  std::map<node_id, foreseen> predicates;
  for (const node& n : g.nodes) {
    if (n.kind != operation::read || predicates.contains(n.operands[0])) continue;
    const operation kind = g.nodes[n.operands[0]].kind;
    if (kind == operation::constant || kind == operation::register_value) continue;
    auto gates = gates_of(g, n.operands[0]);
    if (!gates) continue;
    const std::optional<llvm::APInt> initial = initial_value(g, *gates);
    if (!initial) continue;
    dataflow::register_state r;
    r.name = g.ports[n.object].name + "_needed";
    r.initial = initial;
    r.next = r.enable = 0;  // set at the end
    r.where = n.where;
    predicates[n.operands[0]] = {std::move(*gates), static_cast<register_id>(g.registers.size())};
    g.registers.push_back(std::move(r));
  }
  if (predicates.empty()) return false;
  std::vector<node_id> moved(g.nodes.size(), none);
  rebuild(
      g,
      [&](builder& b, node n, node_id id) {
        if (n.kind == operation::read) {
          if (const auto found = predicates.find(g.nodes[id].operands[0]); found != predicates.end()) {
            n.operands[0] = b.register_value(found->second.state);
          }
        }
        return moved[id] = b.make(std::move(n));
      },
      {},
      [&](builder& b) {
        for (const auto& [predicate, p] : predicates) {
          const node_id next = predicate_of(b, g, p.gates, [&](const node& n) {
            const dataflow::register_state& r = g.registers[n.object];
            return b.select(moved[r.enable], moved[r.next], b.make(n));
          });
          b.target().registers[p.state].next = next;
          b.target().registers[p.state].enable = b.bit(true);
        }
      });
  return true;
}

}  // namespace epiline::passes
