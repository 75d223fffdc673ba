#include "schedule/chains.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "schedule/timing.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;

chains::chains(const graph& g, const delay_model& model, const problem& p)
    : g_(g), model_(model), p_(p), settled_(p.is_settled()) {
  collect_ways();
}

void chains::collect_ways() {
  delay_.resize(g_.nodes.size());
  spread_ = find_spread(g_, model_);
  ways_.resize(g_.nodes.size());
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    delay_[id] = model_.delay(g_, id);
    if (settled_[id]) continue;
    const node& n = g_.nodes[id];
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      if (!settled_[operand])
        ways_[operand].push_back({p_.of_node(id), model_.entry(g_, id, i), spread_.after[operand]});
    }
    if (n.kind == operation::read && !settled_[n.operands[0]]) {
      ways_[n.operands[0]].push_back({0, model_.parameters().issue, spread_.after[n.operands[0]]});
    }
  }
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    const dataflow::register_state& state = g_.registers[r];
    if (!settled_[state.next]) ways_[state.next].push_back({p_.of_update(r), 0, spread_.after[state.next]});
    if (!settled_[state.enable]) {
      ways_[state.enable].push_back({p_.of_update(r), model_.enable_entry(), spread_.after[state.enable]});
    }
  }
  // The patient mark only starts the hold: it is gated with the issue, which does not wait for it.
  if (g_.patient != none && !settled_[g_.patient]) {
    ways_[g_.patient].push_back({0, model_.enable_entry(), spread_.after[g_.patient]});
  }
}

node_id chains::add_chains(double period, double calm, const std::vector<std::uint32_t>& component,
                           std::vector<constraint>& constraints) const {
  const double around = model_.parameters().launch + model_.parameters().capture - tolerance;
  const double full_budget = period - around;
  // What many readers cost counts where a register can help, which is outside recurrences. Whoever is on the way
  // between two of one component is of that component, so what a chain's part may not do, the whole chain may not do
  // either.
  std::vector<double> arrival(p_.count(), -1);
  std::vector<double> spread_arrival(p_.count(), -1);  // with what many readers cost
  const auto too_long = [&](node_id start, variable end) {
    if (component[p_.of_node(start)] == component[end]) return arrival[end] > full_budget;
    return spread_arrival[end] > calm - around;
  };
  // Backwards, so that what a node's successors already forbid need not be forbidden again.
  std::vector<std::vector<variable>> forbidden(g_.nodes.size());
  std::vector<std::uint32_t> implied(p_.count(), none);
  for (node_id start = static_cast<node_id>(g_.nodes.size()); start-- > 0;) {
    if (settled_[start]) continue;
    if (delay_[start] > full_budget) return start;
    if (p_.latency(start) > 0) continue;
    const bool wire = is_wire(g_, start);
    std::vector<variable>& mine = forbidden[start];
    for (const way& w : ways_[start]) {
      const node_id successor = p_.node_of(w.to);
      if (successor == none) continue;
      for (const variable v : forbidden[successor]) {
        if (implied[v] == start) continue;
        implied[v] = start;
        if (wire) mine.push_back(v);
      }
    }
    // A chain that starts with a wire is no longer than the one that starts behind it, unless it ends right there.
    std::priority_queue<variable, std::vector<variable>, std::greater<>> work;
    std::vector<variable> touched;
    const auto reach = [&](const way& w, double from, double spread_from) {
      double& a = arrival[w.to];
      const node_id target = p_.node_of(w.to);
      const double here = w.entry + (target == none ? 0 : delay_[target]);
      const double at = from + here;
      const double spread_at = spread_from + here + w.spread + (target == none ? 0 : spread_.before[target]);
      if (a < 0) {
        if (w.to != 0) work.push(w.to);  // the decision to issue comes last: it is looked at when all ways are known
        touched.push_back(w.to);
      }
      a = std::max(a, at);
      spread_arrival[w.to] = std::max(spread_arrival[w.to], spread_at);
    };
    for (const way& w : ways_[start]) {
      if (wire && w.entry == 0 && w.spread == 0 && p_.node_of(w.to) != none) continue;
      reach(w, delay_[start], delay_[start] + spread_.before[start]);
    }
    const auto forbid = [&](variable v) {
      constraints.push_back({p_.of_node(start), v, 1, reason::chain});
      mine.push_back(v);
    };
    while (!work.empty()) {
      const variable v = work.top();
      work.pop();
      if (implied[v] == start) {  // a successor's rule separates it already, and all that follows
        if (!wire) mine.push_back(v);
        continue;
      }
      if (too_long(start, v)) {
        forbid(v);
        continue;
      }
      const node_id target = p_.node_of(v);
      if (target == none || p_.latency(target) > 0) continue;
      for (const way& w : ways_[target]) reach(w, arrival[v], spread_arrival[v]);
    }
    if (arrival[0] >= 0 && too_long(start, 0) && implied[0] != start) forbid(0);
    for (const variable v : touched) arrival[v] = spread_arrival[v] = -1;
  }
  return none;
}

/// Stages from a value's own to its readers', or 0: as usual.
int chains::stages_to_readers(node_id id) const {
  const delay_parameters& d = model_.parameters();
  const node& n = g_.nodes[id];
  if (n.kind == operation::read) return 1;
  if (p_.latency(id) > 0) {
    if (n.kind != operation::memory_read) return 0;
    const dataflow::memory& m = g_.memories[n.object];
    return model_.blocks(m.words, m.width) >= d.many_blocks ? p_.latency(id) + 1 : 0;
  }
  return spread_.readers[id] >= d.very_many_readers && !is_wire(g_, id) ? 2 : 0;
}

void chains::add_distribution(const std::vector<std::uint32_t>& component, std::vector<constraint>& constraints) const {
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const int stages = settled_[id] ? 0 : stages_to_readers(id);
    if (stages == 0) continue;
    for (const way& w : ways_[id]) {
      if (w.to == 0 || p_.decides_issue(w.to) || component[w.to] == component[p_.of_node(id)]) continue;
      constraints.push_back({p_.of_node(id), w.to, stages, reason::order});
    }
  }
}

double chains::trace(node_id from, variable to, std::vector<chain_link>& chain) const {
  // Longest way by node order; the graph between the two is small.
  std::vector<std::pair<double, node_id>> best(p_.count(), {-1, none});
  std::priority_queue<variable, std::vector<variable>, std::greater<>> work;
  best[p_.of_node(from)] = {delay_[from], none};
  work.push(p_.of_node(from));
  while (!work.empty()) {
    const variable v = work.top();
    work.pop();
    const node_id here = p_.node_of(v);
    if (here == none || v == to || p_.latency(here) > 0) continue;
    for (const way& w : ways_[here]) {
      const node_id target = p_.node_of(w.to);
      if (target != none && w.to > to && p_.node_of(to) != none) continue;
      const double at = best[v].first + w.entry + (target == none ? 0 : delay_[target]);
      if (best[w.to].first < 0) work.push(w.to);
      if (at > best[w.to].first) best[w.to] = {at, here};
    }
  }
  std::vector<chain_link> reversed;
  variable v = to;
  double after = best[to].first;
  if (after < 0) return 0;
  while (v != none) {
    const node_id previous = best[v].second;
    const double before = previous == none ? 0 : best[p_.of_node(previous)].first;
    if (p_.node_of(v) != none) {
      reversed.push_back({p_.node_of(v), best[v].first - before});
    } else if (previous != none) {
      reversed.push_back({none, best[v].first - before});
    }
    if (previous == none) break;
    v = p_.of_node(previous);
  }
  // What an end without a node of its own costs belongs to the node before it.
  if (!reversed.empty() && reversed.front().node == none) {
    if (reversed.size() > 1) reversed[1].delay += reversed.front().delay;
    reversed.erase(reversed.begin());
  }
  chain.insert(chain.end(), reversed.rbegin(), reversed.rend());
  return after + model_.parameters().launch + model_.parameters().capture;
}

}  // namespace epiline::schedule
