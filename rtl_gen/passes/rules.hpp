#pragma once
// Rewriting rules the builder applies to every node it is asked for, one file a family. A rule looks at a node and its
// operands only; it returns the id of something cheaper that computes the same, or `none`.

#include "passes/builder.hpp"

namespace epiline::passes {

/// All rules for the kind of `n`, whose operands are in order (a constant of a commutative operation stands second).
node_id apply_rules(builder& b, const node& n);

node_id simplify_slice(builder& b, const node& n);
node_id simplify_concat(builder& b, const node& n);
node_id simplify_extension(builder& b, const node& n);
node_id simplify_shift(builder& b, const node& n);
node_id simplify_table(builder& b, const node& n);

node_id simplify_bitwise(builder& b, const node& n);  // and, or, xor
node_id simplify_not(builder& b, const node& n);
node_id simplify_select(builder& b, const node& n);

node_id simplify_add(builder& b, const node& n);
node_id simplify_subtract(builder& b, const node& n);
node_id simplify_multiply(builder& b, const node& n);
node_id simplify_division(builder& b, const node& n);

node_id simplify_equal(builder& b, const node& n);
node_id simplify_less(builder& b, const node& n);

/// `id` as pieces, high first: the operands of a concat, the zeros above a zero extension, the runs of equal bits of a
/// constant, else the node itself.
std::vector<node_id> pieces_of(builder& b, node_id id);

}  // namespace epiline::passes
