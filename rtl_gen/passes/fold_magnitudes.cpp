#include "passes/fold_magnitudes.hpp"

#include "passes/builder.hpp"
#include "passes/known_values.hpp"
#include "passes/remove_dead.hpp"

namespace epiline::passes {

namespace {

/// negated ? -value : value, at the width of `value`.
struct magnitude {
  node_id value = none;
  node_id negated = none;
  /// A signed value that may be extended before it is negated, to the same result; none: the sum may wrap.
  node_id extensible = none;
};

class folder {
 public:
  explicit folder(graph& g) : g_(g), known_(g), only_summed_(g.nodes.size(), true), new_id_(g.nodes.size(), none) {
    for (const auto& r : g.registers) only_summed_[r.next] = only_summed_[r.enable] = false;
    if (g.patient != none) only_summed_[g.patient] = false;
    for (node_id id = static_cast<node_id>(g.nodes.size()); id-- > 0;) {  // users stand behind what they use
      const node& n = g.nodes[id];
      const bool sum = n.kind == operation::add || n.kind == operation::subtract;
      const bool passed_on = n.kind == operation::extend_zero && only_summed_[id];
      if (sum || passed_on) continue;
      for (const node_id operand : n.operands) only_summed_[operand] = false;
    }
  }

  void run() {
    rebuild(g_, [this](builder& b, node n, node_id id) {
      node_id result = none;
      if (n.kind == operation::add || n.kind == operation::subtract) result = fold(b, id);
      return new_id_[id] = result != none ? result : b.make(std::move(n));
    });
    remove_dead(g_);
  }

 private:
  node_id fold(builder& b, node_id id) const {
    const node& n = g_.nodes[id];
    // Only what is added second can be subtracted.
    for (const std::size_t i : {1, 0}) {
      if (n.kind == operation::subtract && i == 0) break;
      if (const node_id result = fold_operand(b, id, n.operands[i], n.operands[1 - i]); result != none) return result;
    }
    const magnitude whole = magnitude_of(id);
    if (whole.value == none) return none;
    return b.make(operation::add_or_subtract, n.width,
                  {b.constant(n.width, 0), new_id_[whole.value], new_id_[whole.negated]});
  }

  /// `other` +- `operand` when the operand is a magnitude, possibly extended, that is used in sums only: each of them
  /// can do the same, and nobody needs the magnitude itself.
  node_id fold_operand(builder& b, node_id sum, node_id operand, node_id other) const {
    const unsigned width = g_.nodes[sum].width;
    node_id inner = operand;
    if (g_.nodes[inner].kind == operation::extend_zero) inner = g_.nodes[inner].operands[0];
    if (!only_summed_[inner]) return none;
    const magnitude found = magnitude_of(inner);
    const node_id value = inner == operand ? found.value : found.extensible;
    if (value == none) return none;
    const bool subtract = g_.nodes[sum].kind == operation::subtract;
    const node_id negated = subtract ? b.bit_not(new_id_[found.negated]) : new_id_[found.negated];
    return b.make(operation::add_or_subtract, width, {new_id_[other], b.resize_sign(new_id_[value], width), negated});
  }

  magnitude magnitude_of(node_id id) const {
    const node& sum = g_.nodes[id];
    if (sum.kind != operation::add) return {};
    for (const std::size_t i : {0, 1}) {
      const node& inverted = g_.nodes[sum.operands[i]];
      const node& one = g_.nodes[sum.operands[1 - i]];
      if (inverted.kind != operation::bit_xor || one.kind != operation::extend_zero) continue;
      const node_id negated = one.operands[0];
      if (g_.nodes[negated].width != 1) continue;
      for (const std::size_t k : {0, 1}) {
        const node& mask = g_.nodes[inverted.operands[k]];
        if (mask.kind != operation::extend_sign || mask.operands[0] != negated) continue;
        const node_id value = inverted.operands[1 - k];
        return {value, negated, extensible(value, negated)};
      }
    }
    return {};
  }

  /// `value` as a signed number whose sign is `negated`: itself, or one bit wider where it is the low part of that.
  node_id extensible(node_id value, node_id negated) const {
    const node& sign = g_.nodes[negated];
    if (sign.kind != operation::slice) return none;
    const node_id whole = sign.operands[0];
    const unsigned width = g_.nodes[whole].width;
    if (sign.low != width - 1) return none;
    if (whole == value) return value;  // the magnitude of w bits with sign fits into w bits without
    const node& low = g_.nodes[value];
    if (low.kind != operation::slice || low.operands[0] != whole || low.low != 0 || low.width + 1 != width) return none;
    return known_.of_node(whole).range.getSignedMin().isMinSignedValue() ? none : whole;
  }

  graph& g_;
  known_values known_;
  std::vector<bool> only_summed_;  // all uses are additions and subtractions, extensions on the way aside
  std::vector<node_id> new_id_;
};

}  // namespace

void fold_magnitudes(graph& g) { folder(g).run(); }

}  // namespace epiline::passes
