// Rules for and, or, xor, not and select.
#include <algorithm>
#include <utility>

#include "passes/rules.hpp"

namespace epiline::passes {

namespace {

// A constant mask with more runs of equal bits than this stays one operation: more pieces would only be harder to read.
constexpr std::size_t max_pieces = 12;

bool is_not_of(const builder& b, node_id a, node_id of) {
  return b.kind(a) == operation::bit_not && b.operand(a, 0) == of;
}

/// How many pieces pieces_of() makes of a value.
std::size_t count_pieces(const builder& b, node_id id) {
  if (b.kind(id) == operation::extend_zero) return 1 + count_pieces(b, b.operand(id, 0));
  if (b.kind(id) == operation::concat) return b.at(id).operands.size();
  if (!b.is_constant(id)) return 1;
  const llvm::APInt value = b.value(id);
  return 1 + (value ^ value.ashr(1)).popcount();
}

/// and, or, xor of two operands of which one has constant pieces: done piece by piece, constant pieces being wires.
node_id by_pieces(builder& b, const node& n) {
  const auto has_constant = [&](node_id id) {
    if (b.kind(id) == operation::extend_zero || b.is_constant(id)) return true;
    if (b.kind(id) != operation::concat) return false;
    const auto& parts = b.at(id).operands;
    return std::any_of(parts.begin(), parts.end(), [&](node_id part) { return b.is_constant(part); });
  };
  if (!has_constant(n.operands[0]) && !has_constant(n.operands[1])) return none;
  const std::size_t pieces = count_pieces(b, n.operands[0]) + count_pieces(b, n.operands[1]);
  if (pieces == 2 || pieces > max_pieces) return none;
  const std::vector<node_id> x = pieces_of(b, n.operands[0]), y = pieces_of(b, n.operands[1]);
  // Cut both where either is cut. A cut that frees no constant piece would only split an operation: those are joined.
  struct segment {
    unsigned low, width;
    bool constant;
  };
  std::vector<segment> segments;
  unsigned top = n.width;
  for (std::size_t i = 0, k = 0, x_top = n.width, y_top = n.width; top > 0;) {
    const auto x_low = static_cast<unsigned>(x_top) - b.width(x[i]),
               y_low = static_cast<unsigned>(y_top) - b.width(y[k]);
    const unsigned bottom = std::max(x_low, y_low);
    const bool constant = b.is_constant(x[i]) || b.is_constant(y[k]);
    if (!constant && !segments.empty() && !segments.back().constant) {
      segments.back().width += top - bottom;
      segments.back().low = bottom;
    } else {
      segments.push_back({bottom, top - bottom, constant});
    }
    if (x_low == bottom) x_top = x_low, ++i;
    if (y_low == bottom) y_top = y_low, ++k;
    top = bottom;
  }
  if (segments.size() == 1) return none;
  std::vector<node_id> parts;
  for (const segment& s : segments)
    parts.push_back(
        b.make(n.kind, s.width, {b.slice(n.operands[0], s.low, s.width), b.slice(n.operands[1], s.low, s.width)}));
  return b.concat(std::move(parts));
}

}  // namespace

node_id simplify_bitwise(builder& b, const node& n) {
  const node_id x = n.operands[0], y = n.operands[1];
  const bool is_and = n.kind == operation::bit_and, is_or = n.kind == operation::bit_or;
  if (x == y) return is_and || is_or ? x : b.constant(n.width, 0);
  if (b.is_zero(y)) return is_and ? y : x;
  if (b.is_ones(y)) return is_and ? x : is_or ? y : b.bit_not(x);
  if (is_not_of(b, x, y) || is_not_of(b, y, x))
    return b.constant(is_and ? llvm::APInt(n.width, 0) : llvm::APInt::getAllOnes(n.width));
  if (n.kind == operation::bit_xor) {
    if (b.kind(x) == operation::bit_not) return b.bit_not(b.bit_xor(b.operand(x, 0), y));
    if (b.kind(y) == operation::bit_not) return b.bit_not(b.bit_xor(x, b.operand(y, 0)));
    return by_pieces(b, n);
  }
  // Absorption: what one operand already says need not be said inside the other.
  const operation dual = is_and ? operation::bit_or : operation::bit_and;
  for (const auto& [outer, inner] : {std::pair(x, y), std::pair(y, x)}) {
    if (b.kind(inner) != n.kind && b.kind(inner) != dual) continue;
    const bool same_kind = b.kind(inner) == n.kind;
    for (std::size_t i = 0; i < 2; ++i) {
      const node_id part = b.operand(inner, i), other = b.operand(inner, 1 - i);
      if (part == outer) return same_kind ? inner : outer;
      if (!is_not_of(b, part, outer) && !is_not_of(b, outer, part)) continue;
      if (same_kind) return b.constant(is_and ? llvm::APInt(n.width, 0) : llvm::APInt::getAllOnes(n.width));
      return b.make(n.kind, n.width, {outer, other});
    }
  }
  return by_pieces(b, n);
}

node_id simplify_not(builder& b, const node& n) {
  const node_id a = n.operands[0];
  return b.kind(a) == operation::bit_not ? b.operand(a, 0) : none;
}

/// The operands, at its width, of a difference or of the low bits of a wider one; `none` for anything else.
std::pair<node_id, node_id> difference_of(builder& b, node_id id) {
  const unsigned width = b.width(id);
  if (b.kind(id) == operation::slice && b.at(id).low == 0) id = b.operand(id, 0);
  if (b.kind(id) != operation::subtract) return {none, none};
  const node_id left = b.operand(id, 0), right = b.operand(id, 1);
  return {b.slice(left, 0, width), b.slice(right, 0, width)};
}

/// Whether one = -zero, as far as differences tell: p - q and q - p.
bool is_negation(builder& b, node_id one, node_id zero) {
  const auto [p, q] = difference_of(b, one);
  if (p == none) return false;
  if (b.is_zero(p) && q == zero) return true;
  const auto [r, s] = difference_of(b, zero);
  return r != none && p == s && q == r;
}

node_id simplify_select(builder& b, const node& n) {
  const node_id c = n.operands[0], one = n.operands[1], zero = n.operands[2];
  if (one == zero) return one;
  if (b.is_constant(c)) return b.is_zero(c) ? zero : one;
  if (b.kind(c) == operation::bit_not) return b.select(b.operand(c, 0), zero, one);
  if (n.width == 1) {
    if (one == c) return b.bit_or(c, zero);
    if (zero == c) return b.bit_and(c, one);
    if (b.is_constant(one)) return b.is_zero(one) ? b.bit_and(b.bit_not(c), zero) : b.bit_or(c, zero);
    if (b.is_constant(zero)) return b.is_zero(zero) ? b.bit_and(c, one) : b.bit_or(b.bit_not(c), one);
    if (is_not_of(b, one, zero) || is_not_of(b, zero, one)) return b.bit_xor(c, zero);
  }
  // The same condition asked again inside an arm.
  if (b.kind(one) == operation::select && b.operand(one, 0) == c) return b.select(c, b.operand(one, 1), zero);
  if (b.kind(zero) == operation::select && b.operand(zero, 0) == c) return b.select(c, one, b.operand(zero, 2));
  // One arm again inside the other: select(c, a, select(d, a, e)) = select(c | d, a, e), and so on.
  if (b.kind(zero) == operation::select) {
    const node_id d = b.operand(zero, 0);
    if (b.operand(zero, 1) == one) return b.select(b.bit_or(c, d), one, b.operand(zero, 2));
    if (b.operand(zero, 2) == one) return b.select(b.bit_and(b.bit_not(c), d), b.operand(zero, 1), one);
  }
  if (b.kind(one) == operation::select) {
    const node_id d = b.operand(one, 0);
    if (b.operand(one, 2) == zero) return b.select(b.bit_and(c, d), b.operand(one, 1), zero);
    if (b.operand(one, 1) == zero) return b.select(b.bit_and(c, b.bit_not(d)), b.operand(one, 2), zero);
  }
  // Negate if: (x ^ c) + c takes one adder and no multiplexer, and no branch when simulated.
  if (n.width > 1) {
    const bool negate_one = is_negation(b, one, zero);
    if (negate_one || is_negation(b, zero, one)) {
      const node_id negate = negate_one ? c : b.bit_not(c);
      const node_id inverted = b.bit_xor(negate_one ? zero : one, b.make(operation::extend_sign, n.width, {negate}));
      return b.add(inverted, b.make(operation::extend_zero, n.width, {negate}));
    }
  }
  // The same extension on both arms is done once, behind the select.
  if (b.kind(one) == b.kind(zero) && (b.kind(one) == operation::extend_zero || b.kind(one) == operation::extend_sign)) {
    const operation extension = b.kind(one);
    node_id x = b.operand(one, 0), y = b.operand(zero, 0);
    const unsigned width = std::max(b.width(x), b.width(y));
    if (b.width(x) != width) x = b.make(extension, width, {x});
    if (b.width(y) != width) y = b.make(extension, width, {y});
    return b.make(extension, n.width, {b.select(c, x, y)});
  }
  return none;
}

}  // namespace epiline::passes
