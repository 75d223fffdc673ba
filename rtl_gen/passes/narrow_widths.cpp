// How it works. From what is known and demanded of a value follows its `shape`: how many low bits to keep and how the
// others follow from them. Each node is made at its shape's width and extended back to its old width; as users cut
// their operands to their own width, the builder's rules cancel extensions against cuts, and only the narrow value
// remains. What holds for every node of the new graph: the demanded bits are those of the old one.
#include "passes/narrow_widths.hpp"

#include <algorithm>

#include "passes/builder.hpp"
#include "passes/demanded_bits.hpp"
#include "passes/known_values.hpp"

namespace epiline::passes {

namespace {

using llvm::APInt;

struct shape {
  unsigned width = 1;
  bool sign = false;  // the bits above repeat the top one kept
};

/// `demanded` is what demanded_bits made of it with the same knowledge: of the bits that only repeat the sign it holds
/// the lowest one if any. So the bit repeated here is right in the new graph, which only has the demanded bits right.
shape shape_for(const value_set& known, const APInt& demanded) {
  const unsigned needed = std::max(1u, demanded.getActiveBits());
  const unsigned zero = known.unsigned_bits(), sign = known.signed_bits();
  if (zero <= sign) return {std::min(needed, zero), false};
  return {std::min(needed, sign), needed >= sign};
}

class narrower {
 public:
  explicit narrower(graph& g) : g_(g), known_(g), demanded_(g, &known_) {}

  void run() {
    for (register_id r = 0; r < g_.registers.size(); ++r) {
      auto& state = g_.registers[r];
      register_shapes_.push_back(shape_for(known_.of_register(r), demanded_.of_register(r)));
      state.width = register_shapes_[r].width;
      if (state.initial) state.initial = state.initial->trunc(state.width);
    }
    for (memory_id m = 0; m < g_.memories.size(); ++m) {
      memory_shapes_.push_back(shape_for(known_.of_memory(m), demanded_.of_memory(m)));
      cut(g_.memories[m].width, g_.memories[m].initial, memory_shapes_[m].width);
    }
    for (std::uint32_t t = 0; t < g_.tables.size(); ++t) {
      table_shapes_.push_back(shape_for(known_.of_table(t), demanded_.of_table(t)));
      cut(g_.tables[t].width, g_.tables[t].values, table_shapes_[t].width);
    }
    rebuild(
        g_, [this](builder& b, node n, node_id id) { return rewrite(b, std::move(n), id); },
        [this](builder& b, register_id r, node_id next) { return b.slice(next, 0, register_shapes_[r].width); });
  }

 private:
  static void cut(unsigned& width, std::vector<APInt>& values, unsigned to) {
    width = to;
    for (APInt& value : values) value = value.trunc(to);
  }

  /// `width` bits again from the bits a shape keeps.
  static node_id restore(builder& b, node_id id, const shape& s, unsigned width) {
    const node_id kept = b.slice(id, 0, s.width);
    return s.sign ? b.resize_sign(kept, width) : b.resize_zero(kept, width);
  }

  const value_set& known_operand(node_id id, std::size_t i) const { return known_.of_node(g_.nodes[id].operands[i]); }

  /// An address or shift amount without its known zeros.
  node_id without_zeros(builder& b, node_id operand, node_id old_id, std::size_t i) const {
    return b.slice(operand, 0, std::min(b.width(operand), known_operand(old_id, i).unsigned_bits()));
  }

  node_id rewrite(builder& b, node n, node_id id) {
    switch (n.kind) {
      case operation::read:
      case operation::write:
        return b.make(std::move(n));
      case operation::memory_write:
        n.operands[0] = without_zeros(b, n.operands[0], id, 0);
        n.operands[1] = b.slice(n.operands[1], 0, memory_shapes_[n.object].width);
        return b.make(std::move(n));
      default:
        break;
    }
    const value_set& known = known_.of_node(id);
    const APInt& demanded = demanded_.of_node(id);
    if (known.is_single()) return b.constant(known.bits.getConstant());
    if (demanded.isZero()) return b.constant(n.width, 0);
    const unsigned width = n.width;
    return restore(b, make_narrow(b, std::move(n), id, shape_for(known, demanded)), shape_for(known, demanded), width);
  }

  /// `n` with at least the bits `s` keeps; what stands above them is not looked at.
  node_id make_narrow(builder& b, node n, node_id id, const shape& s) {
    switch (n.kind) {
      case operation::register_value:
        return make_state(b, std::move(n), register_shapes_);
      case operation::memory_read:
        n.operands[0] = without_zeros(b, n.operands[0], id, 0);
        return make_state(b, std::move(n), memory_shapes_);
      case operation::table:
        n.operands[0] = without_zeros(b, n.operands[0], id, 0);
        return make_state(b, std::move(n), table_shapes_);
      case operation::add:
      case operation::subtract:
      case operation::multiply:
      case operation::bit_and:
      case operation::bit_or:
      case operation::bit_xor:
      case operation::bit_not:  // low bits depend on low bits only
        for (node_id& operand : n.operands) operand = b.slice(operand, 0, s.width);
        n.width = s.width;
        return b.make(std::move(n));
      case operation::select:
        n.operands[1] = b.slice(n.operands[1], 0, s.width);
        n.operands[2] = b.slice(n.operands[2], 0, s.width);
        n.width = s.width;
        return b.make(std::move(n));
      case operation::shift_left:
        n.operands[0] = b.slice(n.operands[0], 0, s.width);
        n.operands[1] = without_zeros(b, n.operands[1], id, 1);
        n.width = s.width;
        return b.make(std::move(n));
      case operation::shift_right_logical:
      case operation::shift_right_arithmetic:
        return make_right_shift(b, std::move(n), id);
      case operation::divide_unsigned:
      case operation::divide_signed:
      case operation::remainder_unsigned:
      case operation::remainder_signed:
        return make_division(b, std::move(n), id);
      case operation::equal:
      case operation::less_unsigned:
      case operation::less_signed:
        return make_comparison(b, std::move(n), id);
      default:
        return b.make(std::move(n));
    }
  }

  node_id make_state(builder& b, node n, const std::vector<shape>& shapes) {
    const shape& s = shapes[n.object];
    const unsigned width = n.width;
    n.width = s.width;
    return restore(b, b.make(std::move(n)), s, width);
  }

  node_id make_right_shift(builder& b, node n, node_id id) {
    const value_set& a = known_operand(id, 0);
    const unsigned width = n.width, zero = a.unsigned_bits(), sign = a.signed_bits();
    n.operands[1] = without_zeros(b, n.operands[1], id, 1);
    const bool is_signed = n.kind == operation::shift_right_arithmetic && zero == width;
    if (!is_signed) n.kind = operation::shift_right_logical;  // the sign is known to be 0, or was never meant
    n.width = is_signed ? sign : zero;
    n.operands[0] = b.slice(n.operands[0], 0, n.width);
    const node_id narrow = b.make(std::move(n));
    return is_signed ? b.resize_sign(narrow, width) : b.resize_zero(narrow, width);
  }

  node_id make_division(builder& b, node n, node_id id) {
    const value_set &x = known_operand(id, 0), &y = known_operand(id, 1);
    const unsigned width = n.width;
    const bool quotient = n.kind == operation::divide_unsigned || n.kind == operation::divide_signed;
    const bool is_signed = n.kind == operation::divide_signed || n.kind == operation::remainder_signed;
    const unsigned zero = std::max(x.unsigned_bits(), y.unsigned_bits());
    // A quotient by zero has all bits set, at the width it is computed at.
    const bool may_be_unsigned = zero < width && !(quotient && y.contains_zero());
    const unsigned sign = std::max(x.signed_bits(), y.signed_bits()) + 1;  // least / -1 needs one bit more
    if (may_be_unsigned) {
      n.width = zero;
      n.kind = quotient ? operation::divide_unsigned : operation::remainder_unsigned;
    } else if (is_signed && sign < width) {
      n.width = sign;
    } else {
      return b.make(std::move(n));
    }
    for (node_id& operand : n.operands) operand = b.slice(operand, 0, n.width);
    const node_id narrow = b.make(std::move(n));
    return may_be_unsigned ? b.resize_zero(narrow, width) : b.resize_sign(narrow, width);
  }

  node_id make_comparison(builder& b, node n, node_id id) {
    const value_set &x = known_operand(id, 0), &y = known_operand(id, 1);
    const unsigned zero = std::max(x.unsigned_bits(), y.unsigned_bits());
    const unsigned sign = std::max(x.signed_bits(), y.signed_bits());
    const unsigned width = std::min(zero, sign);
    // Without a sign bit there is no sign; with the sign kept, equality and signed order stay, and unsigned order too.
    if (n.kind == operation::less_signed && zero < b.width(n.operands[0])) {
      n.kind = operation::less_unsigned;
      for (node_id& operand : n.operands) operand = b.slice(operand, 0, zero);
      return b.make(std::move(n));
    }
    for (node_id& operand : n.operands) operand = b.slice(operand, 0, width);
    return b.make(std::move(n));
  }

  graph& g_;
  known_values known_;
  demanded_bits demanded_;
  std::vector<shape> register_shapes_, memory_shapes_, table_shapes_;
};

}  // namespace

void narrow_widths(graph& g) { narrower(g).run(); }

}  // namespace epiline::passes
