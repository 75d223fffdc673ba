#include "schedule/reset_gates.hpp"

#include <algorithm>

#include "schedule/timing.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

namespace {

constexpr unsigned narrowest = 4;       // bits: below, a reset that is another slice's costs more than the LUTs
constexpr int stages_of_condition = 2;  // from a condition to the resets: for flip-flops of its own, and their copies

bool is_zero(const graph& g, node_id id) {
  return g.nodes[id].kind == operation::constant && g.nodes[id].value.isZero();
}

bool may_move(const graph& g, const problem& p, node_id gate) {
  return g.nodes[gate].width >= narrowest && !p.is_settled()[gate] && !p.decides_issue(problem::of_node(gate));
}

bool is_part(const node& n) {
  return n.kind == operation::slice || n.kind == operation::extend_zero || n.kind == operation::extend_sign;
}

bool has_no_gate(operation kind) {
  switch (kind) {
    case operation::add:
    case operation::subtract:
    case operation::add_or_subtract:
    case operation::less_unsigned:
    case operation::less_signed:
    case operation::multiply:
    case operation::memory_read:
    case operation::memory_write:
      return true;
    default:
      return false;
  }
}

class mover {
 public:
  mover(const graph& g, const delay_model& model, const problem& p, const result& s, std::vector<int>& stage)
      : g_(g),
        model_(model),
        p_(p),
        arrival_(analyse(g, model, s).arrival),
        budget_(s.period * model.parameters().calm_share - model.parameters().capture),
        stage_(stage) {
    users_.resize(g.nodes.size());
    last_.assign(g.nodes.size(), -1);
    const auto use = [&](node_id value, node_id user, int at) {
      users_[value].push_back(user);
      last_[value] = std::max(last_[value], at);
    };
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (!p.is_settled()[id])
        for (const node_id operand : g.nodes[id].operands) use(operand, id, at(id));
    for (register_id r = 0; r < g.registers.size(); ++r)
      for (const node_id source : {g.registers[r].next, g.registers[r].enable})
        use(source, none, stage[p.of_update(r)]);
  }

  /// Moves the choices behind `value` if nothing but choices takes it out of its last flip-flops.
  void move_behind(node_id value) {
    const int last = last_[value];
    if (p_.is_settled()[value] || available(value) >= last) return;
    latest_ = is_in_flip_flops(value, last - 1) ? model_.parameters().launch : arrival_[value];
    moved_.clear();
    bits_ = 0;
    helps_ = false;
    if (!collect(value, last) || !helps_ || bits_ > g_.nodes[value].width) return;
    for (const node_id id : moved_) {
      stage_[problem::of_node(id)] = last - 1;
      arrival_[id] = latest_ + model_.delay(g_, id);
      for (const node_id operand : g_.nodes[id].operands) find_last(operand);
    }
  }

 private:
  [[nodiscard]] int at(node_id id) const { return stage_[problem::of_node(id)]; }
  [[nodiscard]] int available(node_id id) const { return at(id) + p_.latency(id); }

  /// Whether `value` is in flip-flops or at a RAM's output when stage `here` begins.
  [[nodiscard]] bool is_in_flip_flops(node_id value, int here) const {
    while (is_part(g_.nodes[value]) && at(value) == here) value = g_.nodes[value].operands[0];
    if (p_.is_settled()[value] || available(value) != here) return !p_.is_settled()[value] && available(value) < here;
    return p_.latency(value) > 0 || g_.nodes[value].kind == operation::register_value;
  }

  /// Everything between `value` and the end of the choices that take it in stage `last`; false: something else does.
  bool collect(node_id value, int last) {
    for (const node_id user : users_[value]) {
      if (user == none) return false;
      if (at(user) < last) continue;
      const node& n = g_.nodes[user];
      moved_.push_back(user);
      if (is_part(n)) {
        if (!collect(user, last) || last_[user] > last) return false;
        continue;
      }
      if (gated_value(g_, n) != value || !may_move(g_, p_, user)) return false;
      const node_id condition = n.operands[0];
      const bool early = p_.is_settled()[condition] || available(condition) + stages_of_condition <= last - 1;
      if (!early || latest_ + model_.delay(g_, user) > budget_) return false;
      bits_ += n.width;
      // One LUT, too, can end in but one flip-flop.
      helps_ =
          helps_ || users_[user].size() > 1 || std::any_of(users_[user].begin(), users_[user].end(), [&](node_id next) {
            return next != none && at(next) == last && leads_to_gateless(next, last);
          });
    }
    return true;
  }

  [[nodiscard]] bool leads_to_gateless(node_id id, int here) const {
    if (has_no_gate(g_.nodes[id].kind)) return true;
    if (!is_wire(g_, id)) return false;
    return std::any_of(users_[id].begin(), users_[id].end(),
                       [&](node_id next) { return next != none && at(next) == here && leads_to_gateless(next, here); });
  }

  void find_last(node_id value) {
    // Moves make uses earlier only where all of a stage move; registers' updates do not move.
    int last = -1;
    for (const node_id user : users_[value]) {
      if (user == none) return;
      last = std::max(last, at(user));
    }
    last_[value] = last;
  }

  const graph& g_;
  const delay_model& model_;
  const problem& p_;
  std::vector<double> arrival_;  // per node: nanoseconds from the clock that begins its stage
  const double budget_;          // and until when a flip-flop may be reached
  std::vector<int>& stage_;
  std::vector<std::vector<node_id>> users_;  // none: a register's update
  std::vector<int> last_;                    // per node: the last stage that uses it
  std::vector<node_id> moved_;
  double latest_ = 0;   // when the value is there that they choose or not
  unsigned bits_ = 0;   // of the choices
  bool helps_ = false;  // one of them is worth moving
};

}  // namespace

node_id gated_value(const graph& g, const node& n) {
  if (n.kind != operation::select || is_zero(g, n.operands[1]) == is_zero(g, n.operands[2])) return none;
  return is_zero(g, n.operands[1]) ? n.operands[2] : n.operands[1];
}

void ask_for_early_conditions(const graph& g, const problem& p, attempt& a) {
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (gated_value(g, n) == none || !may_move(g, p, id) || p.is_settled()[n.operands[0]]) continue;
    const variable condition = problem::of_node(n.operands[0]);
    const int distance = p.latency(n.operands[0]) + stages_of_condition + 1;
    if (a.stage[problem::of_node(id)] - a.stage[condition] >= distance)
      a.system.constraints.push_back({condition, problem::of_node(id), distance, reason::order});
  }
}

void move_gates_to_flip_flops(const graph& g, const delay_model& model, const problem& p, const result& s,
                              std::vector<int>& stage) {
  mover all(g, model, p, s, stage);
  for (node_id id = 0; id < g.nodes.size(); ++id) all.move_behind(id);
}

}  // namespace epiline::schedule
