#include "passes/simplify.hpp"

#include "passes/builder.hpp"
#include "passes/remove_dead.hpp"

namespace epiline::passes {

namespace {

/// A register that is never updated, or only with itself or with its initial constant.
bool keeps_initial_value(const graph& g, const dataflow::register_state& r) {
  const node &next = g.nodes[r.next], &enable = g.nodes[r.enable];
  if (enable.kind == operation::constant && enable.value.isZero()) return true;
  if (next.kind == operation::register_value) return &g.registers[next.object] == &r;
  return next.kind == operation::constant && next.value == r.initial.value_or(llvm::APInt(r.width, 0));
}

}  // namespace

void simplify(graph& g) {
  std::vector<char> fixed;
  for (const auto& r : g.registers) fixed.push_back(keeps_initial_value(g, r));
  rebuild(g, [&](builder& b, node n, node_id) {
    switch (n.kind) {
      case operation::register_value: {
        const auto& r = b.target().registers[n.object];
        if (fixed[n.object]) return b.constant(r.initial.value_or(llvm::APInt(r.width, 0)));
        break;
      }
      case operation::read:
        if (b.is_zero(n.operands[0])) return b.constant(n.width, 0);
        break;
      case operation::write:
        if (b.is_zero(n.operands[0])) return none;
        break;
      case operation::memory_write:
        if (b.is_zero(n.operands[2])) return none;
        if (b.kind(n.operands[0]) == operation::extend_zero) n.operands[0] = b.operand(n.operands[0], 0);
        break;
      default:
        break;
    }
    return b.make(std::move(n));
  });
  remove_dead(g);
}

}  // namespace epiline::passes
