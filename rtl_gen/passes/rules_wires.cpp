// Rules for operations that are wires only: slices, concatenations, extensions, shifts by constants; and tables.
#include "passes/rules.hpp"

namespace epiline::passes {

namespace {

bool is_extension(operation kind) { return kind == operation::extend_zero || kind == operation::extend_sign; }

/// The parts of a concat that cover bits [low, low + width), cut to them.
node_id slice_of_concat(builder& b, node_id concat, unsigned low, unsigned width) {
  const std::vector<node_id> operands = b.at(concat).operands;
  std::vector<node_id> parts;
  unsigned top = b.width(concat);
  for (const node_id part : operands) {
    const unsigned part_width = b.width(part), bottom = top - part_width;
    if (top > low && bottom < low + width) {
      const unsigned first = std::max(bottom, low), last = std::min(top, low + width);
      parts.push_back(b.slice(part, first - bottom, last - first));
    }
    top = bottom;
  }
  return b.concat(std::move(parts));
}

/// Two neighbouring parts of a concat as one, or none.
node_id merge_parts(builder& b, node_id high, node_id low) {
  if (b.is_constant(high) && b.is_constant(low)) return b.constant(b.value(high).concat(b.value(low)));
  if (b.kind(high) != operation::slice || b.kind(low) != operation::slice) return none;
  const node_id source = b.operand(high, 0);
  if (source != b.operand(low, 0) || b.at(high).low != b.at(low).low + b.width(low)) return none;
  return b.slice(source, b.at(low).low, b.width(low) + b.width(high));
}

}  // namespace

std::vector<node_id> pieces_of(builder& b, node_id id) {
  if (b.kind(id) == operation::concat) return b.at(id).operands;
  if (b.kind(id) == operation::extend_zero) {
    const node_id a = b.operand(id, 0);
    std::vector<node_id> pieces = {b.constant(b.width(id) - b.width(a), 0)};
    for (const node_id piece : pieces_of(b, a)) pieces.push_back(piece);
    return pieces;
  }
  if (!b.is_constant(id)) return {id};
  const llvm::APInt value = b.value(id);
  std::vector<node_id> pieces;
  for (unsigned top = value.getBitWidth(); top > 0;) {
    unsigned bottom = top - 1;
    while (bottom > 0 && value[bottom - 1] == value[top - 1]) --bottom;
    pieces.push_back(b.constant(value.extractBits(top - bottom, bottom)));
    top = bottom;
  }
  return pieces;
}

node_id simplify_slice(builder& b, const node& n) {
  const node_id a = n.operands[0];
  if (n.width == b.width(a)) return a;
  switch (b.kind(a)) {
    case operation::slice:
      return b.slice(b.operand(a, 0), b.at(a).low + n.low, n.width);
    case operation::concat:
      return slice_of_concat(b, a, n.low, n.width);
    case operation::extend_zero:
    case operation::extend_sign: {
      const bool sign = b.kind(a) == operation::extend_sign;
      const node_id inner = b.operand(a, 0);
      const unsigned inner_width = b.width(inner);
      if (n.low + n.width <= inner_width) return b.slice(inner, n.low, n.width);
      if (n.low >= inner_width && !sign) return b.constant(n.width, 0);
      const unsigned low = std::min(n.low, inner_width - 1);  // bits above the operand repeat its top one
      const node_id kept = b.slice(inner, low, inner_width - low);
      return sign ? b.resize_sign(kept, n.width) : b.resize_zero(kept, n.width);
    }
    default:
      return none;
  }
}

node_id simplify_concat(builder& b, const node& n) {
  std::vector<node_id> parts;
  bool changed = false;
  for (std::size_t i = 0; i < n.operands.size(); ++i) {
    const node_id part = n.operands[i];
    const bool open = b.kind(part) == operation::concat || b.kind(part) == operation::extend_zero;
    std::vector<node_id> pieces = open ? pieces_of(b, part) : std::vector<node_id>{part};
    changed |= open;
    for (const node_id piece : pieces) {
      const node_id merged = parts.empty() ? none : merge_parts(b, parts.back(), piece);
      changed |= merged != none;
      if (merged != none)
        parts.back() = merged;
      else
        parts.push_back(piece);
    }
  }
  if (parts.size() == 1) return parts[0];
  // What can be said as one extension is.
  const bool zero = b.is_zero(parts[0]), sign = b.kind(parts[0]) == operation::extend_sign;
  if (zero || sign) {
    if (zero)
      parts.erase(parts.begin());
    else
      parts[0] = b.operand(parts[0], 0);
    const node_id kept = b.concat(std::move(parts));
    return zero ? b.resize_zero(kept, n.width) : b.resize_sign(kept, n.width);
  }
  return changed ? b.concat(std::move(parts)) : none;
}

node_id simplify_extension(builder& b, const node& n) {
  const node_id a = n.operands[0];
  if (n.width == b.width(a)) return a;
  if (!is_extension(b.kind(a))) return none;
  // Zeros above zeros, or copies of the sign above either.
  if (b.kind(a) != n.kind && n.kind == operation::extend_zero) return none;
  return b.make(b.kind(a), n.width, {b.operand(a, 0)});
}

node_id simplify_shift(builder& b, const node& n) {
  const node_id a = n.operands[0], amount = n.operands[1];
  if (b.is_zero(a)) return a;
  if (b.kind(amount) == operation::extend_zero) return b.make(n.kind, n.width, {a, b.operand(amount, 0)});
  if (!b.is_constant(amount)) return none;
  const auto by = static_cast<unsigned>(b.value(amount).getLimitedValue(n.width));
  if (by == 0) return a;
  if (n.kind == operation::shift_right_arithmetic) {
    const unsigned low = std::min(by, n.width - 1);
    return b.resize_sign(b.slice(a, low, n.width - low), n.width);
  }
  if (by == n.width) return b.constant(n.width, 0);
  if (n.kind == operation::shift_right_logical) return b.resize_zero(b.slice(a, by, n.width - by), n.width);
  return b.concat({b.slice(a, 0, n.width - by), b.constant(by, 0)});
}

node_id simplify_table(builder& b, const node& n) {
  const node_id address = n.operands[0];
  if (b.kind(address) == operation::extend_zero) {
    node direct = n;
    direct.operands[0] = b.operand(address, 0);
    return b.make(std::move(direct));
  }
  if (!b.is_constant(address)) return none;
  const auto& words = b.target().tables[n.object].values;
  const std::uint64_t index = b.value(address).getLimitedValue();
  return b.constant(index < words.size() ? words[index] : llvm::APInt(n.width, 0));
}

}  // namespace epiline::passes
