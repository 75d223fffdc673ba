// How it works. A tree is a root and the nodes below it that do the same operation and are used by it alone; what they
// combine are its leaves. The leaves are combined again, always the two that are ready first; a leaf on a cycle through
// the root (an accumulator in its own sum) is kept for last, so that the cycle holds one operation. The new tree
// replaces the old one only where it is better.
#include "passes/balance_trees.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

#include "passes/builder.hpp"
#include "passes/cycles.hpp"
#include "passes/known_values.hpp"

namespace epiline::passes {

namespace {

using llvm::APInt;

enum class family {
  other,
  sum,
  bit_and,
  bit_or,
  bit_xor,
  minimum_unsigned,
  maximum_unsigned,
  minimum_signed,
  maximum_signed
};

struct leaf {
  node_id id;
  bool negative = false;  // sums: is subtracted
  bool sign = false;      // sums: extended with its sign, otherwise with zeros, to the root's width
  bool extended = false;  // an extension stands between it and the root, so sums on the way must not wrap
  unsigned distance = 0;  // operations between it and the root
};

struct term {  // a leaf or the combination of some
  bool on_cycle;
  unsigned depth, cycle_depth, order;
  bool negative;
  node_id id;
  bool operator>(const term& o) const {
    return std::tie(on_cycle, depth, order) > std::tie(o.on_cycle, o.depth, o.order);
  }
};

bool is_wire(operation kind) {
  switch (kind) {
    case operation::constant:
    case operation::concat:
    case operation::slice:
    case operation::extend_zero:
    case operation::extend_sign:
    case operation::bit_not:
      return true;
    default:
      return false;
  }
}

class balancer {
 public:
  explicit balancer(graph& g)
      : g_(g),
        known_(g),
        cycle_(cycles_of(g)),
        uses_(g.nodes.size(), 0),
        depth_(g.nodes.size(), 0),
        family_(g.nodes.size(), family::other),
        inner_(g.nodes.size(), 0),
        new_id_(g.nodes.size(), none) {
    for (const node& n : g.nodes)
      for (const node_id operand : n.operands) ++uses_[operand];
    for (const auto& r : g.registers) ++uses_[r.next], ++uses_[r.enable];
    if (g.patient != none) ++uses_[g.patient];
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const node& n = g.nodes[id];
      for (const node_id operand : n.operands) depth_[id] = std::max(depth_[id], depth_[operand]);
      if (n.kind == operation::memory_read || n.kind == operation::read)
        depth_[id] = 0;
      else if (!is_wire(n.kind))
        ++depth_[id];
      family_[id] = family_of(n);
    }
  }

  void run() {
    for (node_id id = static_cast<node_id>(g_.nodes.size()); id-- > 0;)  // roots stand behind their trees
      if (family_[id] != family::other && !inner_[id]) mark_inner(id);
    rebuild(g_, [this](builder& b, node n, node_id id) {
      node_id result = none;
      if (family_[id] != family::other && !inner_[id]) result = rebuild_tree(b, id);
      return new_id_[id] = result != none ? result : b.make(std::move(n));
    });
  }

 private:
  family family_of(const node& n) const {
    switch (n.kind) {
      case operation::add:
      case operation::subtract:
        return family::sum;
      case operation::bit_and:
        return family::bit_and;
      case operation::bit_or:
        return family::bit_or;
      case operation::bit_xor:
        return family::bit_xor;
      case operation::select: {  // select(x < y, x, y) or select(x < y, y, x)
        const node& c = g_.nodes[n.operands[0]];
        if (c.kind != operation::less_unsigned && c.kind != operation::less_signed) return family::other;
        const bool sign = c.kind == operation::less_signed;
        if (n.operands[1] == c.operands[0] && n.operands[2] == c.operands[1])
          return sign ? family::minimum_signed : family::minimum_unsigned;
        if (n.operands[1] == c.operands[1] && n.operands[2] == c.operands[0])
          return sign ? family::maximum_signed : family::maximum_unsigned;
        return family::other;
      }
      default:
        return family::other;
    }
  }

  bool is_minmax(node_id id) const { return family_[id] >= family::minimum_unsigned; }

  /// Used by one node only: a minimum's comparison and selection count as one.
  bool used_once(node_id id, node_id user) const {
    if (!is_minmax(user)) return uses_[id] == 1;
    return uses_[id] == 2 && uses_[g_.nodes[user].operands[0]] == 1;
  }

  /// The leaves under `id`, which is combined into a root of the same family.
  void collect(node_id id, leaf path, std::vector<leaf>& leaves) const {
    const node& n = g_.nodes[id];
    const std::size_t first = is_minmax(id) ? 1 : 0;
    for (std::size_t i = first; i < first + 2; ++i) {
      leaf next = path;
      next.id = n.operands[i];
      next.negative = path.negative != (n.kind == operation::subtract && i == 1);
      next.distance = path.distance + 1;
      add_operand(id, next, leaves);
    }
  }

  void add_operand(node_id user, leaf path, std::vector<leaf>& leaves) const {
    const node_id id = path.id;
    if (family_[id] == family_[user] && used_once(id, user) && (!path.extended || keeps_value(id, path.sign)))
      return collect(id, path, leaves);
    const node& n = g_.nodes[id];
    const bool extension = n.kind == operation::extend_zero || n.kind == operation::extend_sign;
    if (family_[user] == family::sum && extension && uses_[id] == 1) {
      const node_id inner = n.operands[0];
      const bool sign = n.kind == operation::extend_sign;
      const bool compatible = !path.extended || sign == path.sign;
      if (compatible && family_[inner] == family::sum && uses_[inner] == 1 && keeps_value(inner, sign)) {
        path.id = inner;
        path.sign = sign;
        path.extended = true;
        return collect(inner, path, leaves);
      }
    }
    leaves.push_back(path);
  }

  /// A sum that never wraps at its width, taken with or without sign: its terms may be extended instead of it.
  bool keeps_value(node_id id, bool sign) const {
    const node& n = g_.nodes[id];
    const auto &x = known_.of_node(n.operands[0]).range, &y = known_.of_node(n.operands[1]).range;
    bool low = false, high = false;
    if (n.kind == operation::add && !sign) (void)x.getUnsignedMax().uadd_ov(y.getUnsignedMax(), high);
    if (n.kind == operation::subtract && !sign) (void)x.getUnsignedMin().usub_ov(y.getUnsignedMax(), low);
    if (n.kind == operation::add && sign) {
      (void)x.getSignedMin().sadd_ov(y.getSignedMin(), low);
      (void)x.getSignedMax().sadd_ov(y.getSignedMax(), high);
    }
    if (n.kind == operation::subtract && sign) {
      (void)x.getSignedMin().ssub_ov(y.getSignedMax(), low);
      (void)x.getSignedMax().ssub_ov(y.getSignedMin(), high);
    }
    return !low && !high;
  }

  void mark_inner(node_id root) {
    std::vector<leaf> leaves;
    collect(root, {root}, leaves);
    std::vector<node_id> stack(g_.nodes[root].operands);
    // Everything between the root and its leaves is part of this tree and starts none of its own.
    std::vector<node_id> ends;
    for (const leaf& l : leaves) ends.push_back(l.id);
    std::sort(ends.begin(), ends.end());
    while (!stack.empty()) {
      const node_id id = stack.back();
      stack.pop_back();
      if (inner_[id] || std::binary_search(ends.begin(), ends.end(), id)) continue;
      inner_[id] = 1;
      for (const node_id operand : g_.nodes[id].operands) stack.push_back(operand);
    }
  }

  node_id combine(builder& b, family f, const term& x, const term& y) const {
    switch (f) {
      case family::bit_and:
        return b.bit_and(x.id, y.id);
      case family::bit_or:
        return b.bit_or(x.id, y.id);
      case family::bit_xor:
        return b.bit_xor(x.id, y.id);
      case family::sum:
        if (x.negative == y.negative) return b.add(x.id, y.id);
        return x.negative ? b.subtract(y.id, x.id) : b.subtract(x.id, y.id);
      default: {
        const bool sign = f == family::minimum_signed || f == family::maximum_signed;
        const bool minimum = f == family::minimum_signed || f == family::minimum_unsigned;
        const node_id less = b.make(sign ? operation::less_signed : operation::less_unsigned, 1, {x.id, y.id});
        return minimum ? b.select(less, x.id, y.id) : b.select(less, y.id, x.id);
      }
    }
  }

  /// Combines the leaves anew; with `b` null only the measures of the result are computed.
  term build(builder* b, node_id root, const std::vector<leaf>& leaves) const {
    const unsigned width = g_.nodes[root].width, level = is_minmax(root) ? 2 : 1;
    std::priority_queue<term, std::vector<term>, std::greater<>> queue;
    unsigned order = 0;
    for (const leaf& l : leaves) {
      const bool on_cycle = cycle_[l.id] != none && cycle_[l.id] == cycle_[root];
      node_id id = none;
      if (b != nullptr) id = l.sign ? b->resize_sign(new_id_[l.id], width) : b->resize_zero(new_id_[l.id], width);
      queue.push({on_cycle, depth_[l.id], 0, order++, l.negative, id});
    }
    while (queue.size() > 1) {
      const term x = queue.top();
      queue.pop();
      const term y = queue.top();
      queue.pop();
      const unsigned cycle_depth =
          std::max(x.on_cycle ? x.cycle_depth + level : 0, y.on_cycle ? y.cycle_depth + level : 0);
      queue.push({x.on_cycle || y.on_cycle, std::max(x.depth, y.depth) + level, cycle_depth, order++,
                  x.negative && y.negative, b != nullptr ? combine(*b, family_[root], x, y) : none});
    }
    return queue.top();
  }

  node_id rebuild_tree(builder& b, node_id root) const {
    std::vector<leaf> leaves;
    collect(root, {root}, leaves);
    if (leaves.size() < 3) return none;
    unsigned old_cycle_depth = 0;
    for (const leaf& l : leaves)
      if (cycle_[l.id] != none && cycle_[l.id] == cycle_[root])
        old_cycle_depth = std::max(old_cycle_depth, l.distance * (is_minmax(root) ? 2 : 1));
    const term plan = build(nullptr, root, leaves);
    if (std::tie(plan.cycle_depth, plan.depth) >= std::tie(old_cycle_depth, depth_[root])) return none;
    const term result = build(&b, root, leaves);
    return result.negative ? b.subtract(b.constant(g_.nodes[root].width, 0), result.id) : result.id;
  }

  graph& g_;
  known_values known_;
  std::vector<std::uint32_t> cycle_;
  std::vector<unsigned> uses_, depth_;
  std::vector<family> family_;
  std::vector<char> inner_;  // part of a tree, not its root
  std::vector<node_id> new_id_;
};

}  // namespace

void balance_trees(graph& g) { balancer(g).run(); }

}  // namespace epiline::passes
