#include "prove/fault.hpp"

#include <fmt/format.h>

#include <utility>

namespace epiline::prove {

using dataflow::operation;

namespace {

/// An operation of the same operands and width; `kind` itself if there is none.
operation similar(operation kind) {
  switch (kind) {
    case operation::add:
      return operation::subtract;
    case operation::subtract:
    case operation::multiply:
      return operation::add;
    case operation::divide_unsigned:
      return operation::remainder_unsigned;
    case operation::divide_signed:
      return operation::divide_unsigned;
    case operation::remainder_unsigned:
      return operation::divide_unsigned;
    case operation::remainder_signed:
      return operation::remainder_unsigned;
    case operation::bit_and:
      return operation::bit_or;
    case operation::bit_or:
      return operation::bit_xor;
    case operation::bit_xor:
      return operation::bit_and;
    case operation::shift_left:
      return operation::shift_right_logical;
    case operation::shift_right_logical:
      return operation::shift_right_arithmetic;
    case operation::shift_right_arithmetic:
      return operation::shift_right_logical;
    case operation::equal:
      return operation::less_unsigned;
    case operation::less_unsigned:
      return operation::less_signed;
    case operation::less_signed:
      return operation::less_unsigned;
    case operation::extend_zero:
      return operation::extend_sign;
    case operation::extend_sign:
      return operation::extend_zero;
    default:
      return kind;
  }
}

}  // namespace

std::optional<std::string> plant_fault(dataflow::graph& g, dataflow::node_id id) {
  dataflow::node& n = g.nodes[id];
  switch (n.kind) {
    case operation::constant:
      n.value.flipBit(0);
      return "a constant's lowest bit";
    case operation::select:
      std::swap(n.operands[1], n.operands[2]);
      return "a selection's arms";
    case operation::add_or_subtract:
      if (n.operands[0] == n.operands[1]) return {};
      std::swap(n.operands[0], n.operands[1]);
      return "the operands of an add_or_subtract";
    case operation::slice:
      if (n.low + n.width < g.nodes[n.operands[0]].width)
        ++n.low;
      else if (n.low > 0)
        --n.low;
      else
        return {};
      return "the place of a slice";
    default: {
      const operation kind = similar(n.kind);
      if (kind == n.kind) return {};
      std::string what = fmt::format("{} became {}", name_of(n.kind), name_of(kind));
      n.kind = kind;
      return what;
    }
  }
}

dataflow::graph with_fault(dataflow::graph g) {
  for (auto id = static_cast<dataflow::node_id>(g.nodes.size()); id-- > 0;)
    if (plant_fault(g, id)) break;
  return g;
}

}  // namespace epiline::prove
