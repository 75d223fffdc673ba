#include "schedule/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <utility>

#include "schedule/difference_program.hpp"
#include "schedule/fan_out.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;
using dataflow::source_location;

namespace {

constexpr double tolerance = 1e-6;
constexpr int largest_interval = 64;
constexpr double stage_price = 4;  // bits that one more stage costs by itself: its valid bit, its share of the FIFOs

using variable = std::uint32_t;

/// Why a constraint exists.
enum class reason : std::uint8_t { order, data, chain, recurrence, memory, issue };

/// stage[to] - stage[from] >= distance
struct constraint {
  variable from = 0;
  variable to = 0;
  int distance = 0;
  reason why = reason::order;
};

/// A combinational way out of a node: into another node, or into something that ends the stage.
struct way {
  variable to = 0;
  double entry = 0;   // nanoseconds before the target's own delay
  double spread = 0;  // and what it costs more because the value has many readers
};

struct memory_accesses {
  std::vector<node_id> reads;
  std::vector<node_id> writes;
};

bool is_patient(const graph& g, register_id r) { return g.patient != none && g.registers[r].patient; }

std::vector<char> find_settled(const graph& g) {
  std::vector<char> is_settled(g.nodes.size(), 0);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    switch (n.kind) {
      case operation::constant:
        is_settled[id] = 1;
        break;
      case operation::register_value:
        is_settled[id] = is_patient(g, n.object);
        break;
      case operation::read:
      case operation::write:
      case operation::memory_read:
      case operation::memory_write:
      case operation::table:
        break;
      default:
        is_settled[id] = std::all_of(n.operands.begin(), n.operands.end(),
                                     [&](node_id operand) { return is_settled[operand] != 0; });
    }
  }
  return is_settled;
}

/// Strongly connected components by Tarjan's algorithm, without recursion; numbered so that constraints lead from
/// higher numbers to lower ones.
std::vector<std::uint32_t> find_components(std::uint32_t count, const std::vector<constraint>& constraints,
                                           const std::vector<std::uint32_t>& first,
                                           const std::vector<std::uint32_t>& outgoing) {
  constexpr std::uint32_t unseen = none;
  std::vector<std::uint32_t> component(count, unseen), index(count, unseen), low(count), position(count);
  std::vector<variable> open, path;
  std::uint32_t next_index = 0;
  std::uint32_t next_component = 0;
  for (variable root = 0; root < count; ++root) {
    if (index[root] != unseen) continue;
    path.push_back(root);
    while (!path.empty()) {
      const variable v = path.back();
      if (index[v] == unseen) {
        index[v] = low[v] = next_index++;
        position[v] = first[v];
        open.push_back(v);
      }
      bool descended = false;
      while (position[v] < first[v + 1]) {
        const variable w = constraints[outgoing[position[v]]].to;
        if (index[w] == unseen) {
          path.push_back(w);
          descended = true;
          break;
        }
        if (component[w] == unseen) low[v] = std::min(low[v], low[w]);
        ++position[v];
      }
      if (descended) continue;
      path.pop_back();
      if (low[v] == index[v]) {
        for (;;) {
          const variable w = open.back();
          open.pop_back();
          component[w] = next_component;
          if (w == v) break;
        }
        ++next_component;
      }
    }
  }
  return component;
}

/// Everything about a graph that the constraints are made of.
class problem {
 public:
  problem(const graph& g, const delay_model& model) : g_(g), model_(model), settled_(find_settled(g)) {
    const auto nodes = static_cast<variable>(g.nodes.size());
    const auto registers = static_cast<variable>(g.registers.size());
    first_register_ = 1 + nodes;
    first_update_ = first_register_ + registers;
    end_ = first_update_ + registers;
    count_ = end_ + 1;
    collect_accesses();
    collect_ways();
    find_issue_cone();
  }

  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] const std::vector<char>& is_settled() const { return settled_; }
  [[nodiscard]] static variable of_node(node_id id) { return 1 + id; }
  [[nodiscard]] variable of_register(register_id r) const { return first_register_ + r; }
  [[nodiscard]] variable of_update(register_id r) const { return first_update_ + r; }
  [[nodiscard]] variable end() const { return end_; }
  /// The node a variable stands for, `none` for registers' own variables and the origin.
  [[nodiscard]] node_id node_of(variable v) const { return v >= 1 && v < first_register_ ? v - 1 : none; }
  [[nodiscard]] register_id register_of_update(variable v) const {
    return v >= first_update_ && v < end_ ? v - first_update_ : none;
  }
  [[nodiscard]] const std::vector<memory_accesses>& accesses() const { return accesses_; }

  /// Chains: at `period`, a chain that starts with node u may not reach v in the same stage. Returns `none`, or the
  /// node that alone takes longer than the period.
  /// Chains between different `component`s, which no recurrence holds together, get `calm` only instead of `period`.
  node_id add_chains(double period, double calm, const std::vector<std::uint32_t>& component,
                     std::vector<constraint>& constraints) const;

  /// Long ways, outside recurrences, get a clock of their own: values wait in a flip-flop before anything is computed
  /// from them. What very many read has a way as long as the design is wide to its readers' copies of it; tokens come
  /// from the pins; the words of a memory of many block RAMs from all over the device.
  void add_distribution(const std::vector<std::uint32_t>& component, std::vector<constraint>& constraints) const;

  /// All rules but those of the period. `apart`: a memory's writes come a stage after its reads where possible.
  void add_order(int interval, bool apart, std::vector<constraint>& constraints) const;

  /// The slowest way from node `from` to the variable `to`, and its delay from clock to clock.
  double trace(node_id from, variable to, std::vector<chain_link>& chain) const;

  [[nodiscard]] double node_delay(node_id id) const { return delay_[id]; }

 private:
  void collect_accesses();
  void collect_ways();
  void find_issue_cone();

  const graph& g_;
  const delay_model& model_;
  std::vector<char> settled_;
  variable first_register_ = 0;
  variable first_update_ = 0;
  variable end_ = 0;
  std::uint32_t count_ = 0;
  std::vector<memory_accesses> accesses_;
  std::vector<double> delay_;
  spread spread_;
  std::vector<int> latency_;
  std::vector<std::vector<way>> ways_;  // per node
  std::vector<char> in_issue_cone_;     // per node
  std::vector<char> register_in_cone_;  // per register
};

void problem::collect_accesses() {
  accesses_.resize(g_.memories.size());
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const node& n = g_.nodes[id];
    if (n.kind == operation::memory_read) accesses_[n.object].reads.push_back(id);
    if (n.kind == operation::memory_write) accesses_[n.object].writes.push_back(id);
  }
}

void problem::collect_ways() {
  delay_.resize(g_.nodes.size());
  spread_ = find_spread(g_, model_);
  latency_.resize(g_.nodes.size());
  ways_.resize(g_.nodes.size());
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    delay_[id] = model_.delay(g_, id);
    latency_[id] = model_.latency(g_, id);
    if (settled_[id]) continue;
    const node& n = g_.nodes[id];
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      if (!settled_[operand]) ways_[operand].push_back({of_node(id), model_.entry(g_, id, i), spread_.after[operand]});
    }
    if (n.kind == operation::read && !settled_[n.operands[0]]) {
      ways_[n.operands[0]].push_back({0, model_.parameters().issue, spread_.after[n.operands[0]]});
    }
  }
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    const dataflow::register_state& state = g_.registers[r];
    if (!settled_[state.next]) ways_[state.next].push_back({of_update(r), 0, spread_.after[state.next]});
    if (!settled_[state.enable]) {
      ways_[state.enable].push_back({of_update(r), model_.enable_entry(), spread_.after[state.enable]});
    }
  }
  // The patient mark only starts the hold: it is gated with the issue, which does not wait for it.
  if (g_.patient != none && !settled_[g_.patient]) {
    ways_[g_.patient].push_back({0, model_.enable_entry(), spread_.after[g_.patient]});
  }
}

void problem::find_issue_cone() {
  in_issue_cone_.assign(g_.nodes.size(), 0);
  register_in_cone_.assign(g_.registers.size(), 0);
  std::vector<char> memory_seen(g_.memories.size(), 0);
  std::vector<node_id> work;
  const auto visit = [&](node_id id) {
    if (settled_[id] || in_issue_cone_[id]) return;
    in_issue_cone_[id] = 1;
    work.push_back(id);
  };
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (g_.nodes[id].kind == operation::read) visit(id);
  }
  if (g_.patient != none) visit(g_.patient);
  while (!work.empty()) {
    const node& n = g_.nodes[work.back()];
    work.pop_back();
    for (const node_id operand : n.operands) visit(operand);
    if (n.kind == operation::register_value && !register_in_cone_[n.object]) {
      register_in_cone_[n.object] = 1;
      visit(g_.registers[n.object].next);
      visit(g_.registers[n.object].enable);
    }
    if (n.kind == operation::memory_read && !memory_seen[n.object]) {
      memory_seen[n.object] = 1;
      for (const node_id write : accesses_[n.object].writes) visit(write);
    }
  }
}

void problem::add_order(int interval, bool apart, std::vector<constraint>& constraints) const {
  const auto at_least = [&](variable from, variable to, int distance, reason why) {
    constraints.push_back({from, to, distance, why});
  };
  const auto equal = [&](variable a, variable b, reason why) {
    at_least(a, b, 0, why);
    at_least(b, a, 0, why);
  };
  std::vector<node_id> port_write(g_.ports.size(), none);
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (settled_[id]) continue;
    const node& n = g_.nodes[id];
    const variable v = of_node(id);
    // Only what decides the issue works in stage 0, whose valid bit comes late.
    const bool late = !in_issue_cone_[id] && (n.kind == operation::write || n.kind == operation::memory_write);
    at_least(0, v, late ? 1 : 0, reason::order);
    for (const node_id operand : n.operands) {
      if (!settled_[operand]) at_least(of_node(operand), v, latency_[operand], reason::data);
    }
    if (n.kind == operation::read) at_least(v, 0, 0, reason::issue);
    if (n.kind == operation::register_value) {
      equal(of_register(n.object), v, reason::data);
    }
    if (n.kind == operation::write) {
      node_id& first = port_write[n.object];
      if (first == none) {
        first = id;
      } else {
        equal(of_node(first), v, reason::order);
      }
    }
    at_least(v, end_, latency_[id], reason::order);
  }
  if (g_.patient != none && !settled_[g_.patient]) at_least(of_node(g_.patient), 0, 0, reason::issue);
  for (register_id r = 0; r < g_.registers.size(); ++r) {
    const dataflow::register_state& state = g_.registers[r];
    const bool patient = is_patient(g_, r);
    const variable update = of_update(r);
    for (const node_id source : {state.next, state.enable}) {
      if (!settled_[source]) at_least(of_node(source), update, latency_[source], reason::data);
    }
    at_least(0, update, register_in_cone_[r] ? 0 : 1, reason::order);
    at_least(update, end_, 0, reason::order);
    if (patient) continue;
    at_least(0, of_register(r), register_in_cone_[r] ? 0 : 1, reason::order);
    at_least(of_register(r), update, 0, reason::order);
    at_least(update, of_register(r), -(interval - 1), reason::recurrence);
  }
  for (std::size_t m = 0; m < accesses_.size(); ++m) {
    const memory_accesses& a = accesses_[m];
    const int window = static_cast<int>(std::min(g_.memories[m].distance, 1u << 20)) * interval - 1;
    for (const node_id write : a.writes) {
      for (const node_id read : a.reads) {
        at_least(of_node(read), of_node(write), apart && window > 0 ? 1 : 0, reason::memory);
        at_least(of_node(write), of_node(read), -window, reason::memory);
      }
      if (write != a.writes[0]) equal(of_node(a.writes[0]), of_node(write), reason::memory);
    }
    // Reads of one address share one port of the RAM.
    for (std::size_t i = 1; i < a.reads.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (g_.nodes[a.reads[i]].operands[0] != g_.nodes[a.reads[j]].operands[0]) continue;
        equal(of_node(a.reads[j]), of_node(a.reads[i]), reason::memory);
        break;
      }
    }
  }
}

node_id problem::add_chains(double period, double calm, const std::vector<std::uint32_t>& component,
                            std::vector<constraint>& constraints) const {
  const double around = model_.parameters().launch + model_.parameters().capture - tolerance;
  const double full_budget = period - around;
  // What many readers cost counts where a register can help, which is outside recurrences. Whoever is on the way
  // between two of one component is of that component, so what a chain's part may not do, the whole chain may not do
  // either.
  std::vector<double> arrival(count_, -1);
  std::vector<double> spread_arrival(count_, -1);  // with what many readers cost
  const auto too_long = [&](node_id start, variable end) {
    if (component[of_node(start)] == component[end]) return arrival[end] > full_budget;
    return spread_arrival[end] > calm - around;
  };
  // Backwards, so that what a node's successors already forbid need not be forbidden again.
  std::vector<std::vector<variable>> forbidden(g_.nodes.size());
  std::vector<std::uint32_t> implied(count_, none);
  for (node_id start = static_cast<node_id>(g_.nodes.size()); start-- > 0;) {
    if (settled_[start]) continue;
    if (delay_[start] > full_budget) return start;
    if (latency_[start] > 0) continue;
    const bool wire = is_wire(g_, start);
    std::vector<variable>& mine = forbidden[start];
    for (const way& w : ways_[start]) {
      const node_id successor = node_of(w.to);
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
      const node_id target = node_of(w.to);
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
      if (wire && w.entry == 0 && w.spread == 0 && node_of(w.to) != none) continue;
      reach(w, delay_[start], delay_[start] + spread_.before[start]);
    }
    const auto forbid = [&](variable v) {
      constraints.push_back({of_node(start), v, 1, reason::chain});
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
      const node_id target = node_of(v);
      if (target == none || latency_[target] > 0) continue;
      for (const way& w : ways_[target]) reach(w, arrival[v], spread_arrival[v]);
    }
    if (arrival[0] >= 0 && too_long(start, 0) && implied[0] != start) forbid(0);
    for (const variable v : touched) arrival[v] = spread_arrival[v] = -1;
  }
  return none;
}

void problem::add_distribution(const std::vector<std::uint32_t>& component,
                               std::vector<constraint>& constraints) const {
  const delay_parameters& d = model_.parameters();
  // Stages from a value's own to its readers', or 0: as usual.
  const auto wanted = [&](node_id id) {
    const node& n = g_.nodes[id];
    if (n.kind == operation::read) return 1;
    if (latency_[id] > 0) {
      if (n.kind != operation::memory_read) return 0;
      const dataflow::memory& m = g_.memories[n.object];
      return model_.blocks(m.words, m.width) >= d.many_blocks ? latency_[id] + 1 : 0;
    }
    return spread_.readers[id] >= d.very_many_readers && !is_wire(g_, id) ? 2 : 0;
  };
  // What decides the issue is in stage 0.
  const auto at_issue = [&](variable v) {
    if (const node_id target = node_of(v); target != none) return in_issue_cone_[target] != 0;
    const register_id r = register_of_update(v);
    return r != none && register_in_cone_[r] != 0;
  };
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    const int stages = settled_[id] ? 0 : wanted(id);
    if (stages == 0) continue;
    for (const way& w : ways_[id]) {
      if (w.to == 0 || at_issue(w.to) || component[w.to] == component[of_node(id)]) continue;
      constraints.push_back({of_node(id), w.to, stages, reason::order});
    }
  }
}

double problem::trace(node_id from, variable to, std::vector<chain_link>& chain) const {
  // Longest way by node order; the graph between the two is small.
  std::vector<std::pair<double, node_id>> best(count_, {-1, none});
  std::priority_queue<variable, std::vector<variable>, std::greater<>> work;
  best[of_node(from)] = {delay_[from], none};
  work.push(of_node(from));
  while (!work.empty()) {
    const variable v = work.top();
    work.pop();
    const node_id here = node_of(v);
    if (here == none || v == to || (latency_[here] > 0)) continue;
    for (const way& w : ways_[here]) {
      const node_id target = node_of(w.to);
      if (target != none && w.to > to && to < first_register_ && to != 0) continue;
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
    const double before = previous == none ? 0 : best[of_node(previous)].first;
    if (node_of(v) != none) {
      reversed.push_back({node_of(v), best[v].first - before});
    } else if (previous != none) {
      reversed.push_back({none, best[v].first - before});
    }
    if (previous == none) break;
    v = of_node(previous);
  }
  // What an end without a node of its own costs belongs to the node before it.
  if (!reversed.empty() && reversed.front().node == none) {
    if (reversed.size() > 1) reversed[1].delay += reversed.front().delay;
    reversed.erase(reversed.begin());
  }
  chain.insert(chain.end(), reversed.rbegin(), reversed.rend());
  return after + model_.parameters().launch + model_.parameters().capture;
}

/// Constraints indexed by the variable they start from, and their components.
struct system_of_constraints {
  std::vector<constraint> constraints;
  std::vector<std::uint32_t> first;     // per variable, into `outgoing`
  std::vector<std::uint32_t> outgoing;  // constraint numbers
  std::vector<std::uint32_t> component;

  void build(std::uint32_t count) {
    first.assign(count + 1, 0);
    for (const constraint& c : constraints) ++first[c.from + 1];
    for (std::uint32_t v = 0; v < count; ++v) first[v + 1] += first[v];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    outgoing.resize(constraints.size());
    for (std::uint32_t i = 0; i < constraints.size(); ++i) outgoing[next[constraints[i].from]++] = i;
    component = find_components(count, constraints, first, outgoing);
  }

  /// Earliest stages of all variables. Returns an empty vector and the contradicting cycle when there are none.
  std::vector<int> earliest(std::uint32_t count, std::vector<std::uint32_t>& cycle) const {
    std::vector<variable> order(count);
    for (variable v = 0; v < count; ++v) order[v] = v;
    std::sort(order.begin(), order.end(), [&](variable a, variable b) {
      return component[a] != component[b] ? component[a] > component[b] : a < b;
    });
    std::vector<int> stage(count, 0);
    std::vector<std::uint32_t> cause(count, none), mark(count, none);
    for (std::size_t begin = 0; begin < order.size();) {
      std::size_t end = begin;
      while (end < order.size() && component[order[end]] == component[order[begin]]) ++end;
      for (std::size_t round = 1, changed = 1; changed; ++round) {
        changed = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const variable v = order[i];
          for (std::uint32_t e = first[v]; e < first[v + 1]; ++e) {
            const constraint& c = constraints[outgoing[e]];
            if (stage[v] + c.distance <= stage[c.to]) continue;
            stage[c.to] = stage[v] + c.distance;
            cause[c.to] = outgoing[e];
            changed |= component[c.to] == component[v];
          }
        }
        const bool look = (round & (round - 1)) == 0;
        if (changed && look && find_cycle(order, begin, end, cause, mark, cycle)) return {};
      }
      begin = end;
    }
    return stage;
  }

 private:
  /// A cycle among the constraints that raised the variables last has a positive sum.
  bool find_cycle(const std::vector<variable>& order, std::size_t begin, std::size_t end,
                  const std::vector<std::uint32_t>& cause, std::vector<std::uint32_t>& mark,
                  std::vector<std::uint32_t>& cycle) const {
    const auto caused_inside = [&](variable v) {
      return cause[v] != none && component[constraints[cause[v]].from] == component[v];
    };
    for (std::size_t i = begin; i < end; ++i) mark[order[i]] = none;
    for (std::size_t i = begin; i < end; ++i) {
      variable v = order[i];
      while (mark[v] == none && caused_inside(v)) {
        mark[v] = order[i];
        v = constraints[cause[v]].from;
      }
      if (mark[v] != order[i] || !caused_inside(v)) continue;
      const variable start = v;
      do {
        cycle.push_back(cause[v]);
        v = constraints[cause[v]].from;
      } while (v != start);
      std::reverse(cycle.begin(), cycle.end());
      return true;
    }
    return false;
  }
};

/// Fills `s` from the stages of all variables.
void fill(const graph& g, const delay_model& model, const problem& p, const std::vector<int>& stage, result& s) {
  const std::size_t count = g.nodes.size();
  s.stage.assign(count, settled);
  s.available.assign(count, settled);
  s.settle_level.assign(count, 0);
  s.register_stage.assign(g.registers.size(), settled);
  s.register_update.assign(g.registers.size(), 0);
  int last = 0;
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (p.is_settled()[id]) {
      for (const node_id operand : n.operands) {
        s.settle_level[id] = std::max(s.settle_level[id], s.settle_level[operand]);
      }
      if (is_settled_register(g, s, id)) ++s.settle_level[id];
      continue;
    }
    s.stage[id] = stage[p.of_node(id)];
    s.available[id] = s.stage[id] + model.latency(g, id);
    last = std::max(last, s.available[id]);
  }
  bool any_patient = false;
  int settle = 0;
  for (register_id r = 0; r < g.registers.size(); ++r) {
    s.register_update[r] = stage[p.of_update(r)];
    last = std::max(last, s.register_update[r]);
    if (is_patient(g, r)) {
      any_patient = true;
      s.commit = std::max(s.commit, s.register_update[r] + 1);
    } else {
      s.register_stage[r] = stage[p.of_register(r)];
    }
  }
  s.hold = 0;
  if (any_patient) {
    // Iterations in flight go on using the old values: nothing may change before the last of them has.
    const auto note = [&](node_id value, int at) {
      const bool changes = s.stage[value] == settled && g.nodes[value].kind != operation::constant;
      if (changes) s.commit = std::max(s.commit, at);
    };
    for (node_id id = 0; id < count; ++id) {
      if (s.stage[id] == settled) {
        settle = std::max(settle, s.settle_level[id]);
      } else {
        for (const node_id operand : g.nodes[id].operands) note(operand, s.stage[id]);
      }
    }
    for (register_id r = 0; r < g.registers.size(); ++r) {
      note(g.registers[r].next, s.register_update[r]);
      note(g.registers[r].enable, s.register_update[r]);
    }
    last = std::max(last, s.commit);
    s.hold = s.commit + settle;
  } else {
    s.commit = 0;
  }
  s.depth = last + 1;

  std::vector<int> wait(count, 0);
  for (const use& u : uses(g, s)) wait[u.value] = std::max(wait[u.value], u.stage - s.available[u.value]);
  s.pipeline_bits = 0;
  for (node_id id = 0; id < count; ++id) s.pipeline_bits += static_cast<std::uint64_t>(wait[id]) * g.nodes[id].width;
}

/// Arrival times in every stage: what validate() checks and where the critical chain comes from.
struct timing {
  std::vector<double> arrival;    // per node, from the clock to its result
  std::vector<node_id> previous;  // per node, the operand that arrives last in the same stage
  double worst = 0;
  node_id worst_end = none;  // the last node of the slowest chain
  double worst_entry = 0;    // what its end adds after that node
};

timing analyse(const graph& g, const delay_model& model, const result& s) {
  timing t;
  const delay_parameters& p = model.parameters();
  t.arrival.assign(g.nodes.size(), p.launch);
  t.previous.assign(g.nodes.size(), none);
  const auto finish = [&](node_id at, int stage, double entry) {
    const bool chained = s.stage[at] != settled && s.stage[at] == stage && s.available[at] == stage;
    const double total = (chained ? t.arrival[at] : p.launch) + entry + p.capture;
    if (total > t.worst) {
      t.worst = total;
      t.worst_end = at;
      t.worst_entry = entry;
    }
  };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    double in = p.launch;
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      const bool chained =
          s.stage[id] != settled && s.available[operand] == s.stage[id] && s.stage[operand] == s.stage[id];
      const bool wired = s.stage[id] == settled && s.stage[operand] == settled && !is_settled_register(g, s, operand);
      const double at = (chained || wired ? t.arrival[operand] : p.launch) + model.entry(g, id, i);
      if (at > in || (at >= in && t.previous[id] == none && chained)) {
        in = at;
        t.previous[id] = chained ? operand : none;
      }
    }
    t.arrival[id] = in + model.delay(g, id);
    const double total = t.arrival[id] + p.capture;
    if (n.kind != operation::constant && total > t.worst) {
      t.worst = total;
      t.worst_end = id;
      t.worst_entry = 0;
    }
    if (n.kind == operation::read) finish(n.operands[0], 0, p.issue);
  }
  for (register_id r = 0; r < g.registers.size(); ++r) {
    finish(g.registers[r].next, s.register_update[r], 0);
    finish(g.registers[r].enable, s.register_update[r], model.enable_entry());
  }
  if (g.patient != none) finish(g.patient, 0, model.enable_entry());
  return t;
}

void find_critical_chain(const graph& g, const delay_model& model, result& s) {
  const timing t = analyse(g, model, s);
  s.critical_delay = t.worst;
  s.critical_chain.clear();
  for (node_id id = t.worst_end; id != none; id = t.previous[id]) {
    const double before = t.previous[id] == none ? model.parameters().launch : t.arrival[t.previous[id]];
    s.critical_chain.push_back({id, t.arrival[id] - before});
  }
  if (!s.critical_chain.empty()) s.critical_chain.front().delay += t.worst_entry;
  std::reverse(s.critical_chain.begin(), s.critical_chain.end());
}

/// One attempt: constraints for a period and an interval, and their earliest solution.
struct attempt {
  system_of_constraints system;
  std::vector<int> stage;            // empty when there is none
  std::vector<std::uint32_t> cycle;  // the contradiction
  node_id too_slow = none;           // a node that alone exceeds the period

  [[nodiscard]] bool feasible() const { return !stage.empty(); }
};

/// Recurrences: what chains of operations hold together, by variable. A `roomy` memory, whose words come again so late
/// that there is time for registers between its words and what is written, holds nothing together.
std::vector<std::uint32_t> find_recurrences(const std::vector<constraint>& order, std::uint32_t count, bool roomy) {
  constexpr int room = 4;  // stages from the read to the write: two for the RAM, and some for registers
  system_of_constraints tight;
  for (const constraint& c : order)
    if (!roomy || c.why != reason::memory || c.distance > -room) tight.constraints.push_back(c);
  tight.build(count);
  return std::move(tight.component);
}

struct preferences {
  bool apart = true;  // writes a stage after the reads of the same memory: block RAMs then never meet both of one word
  bool roomy = true;  // registers between a memory's words and what is written
};

attempt try_once(const graph& g, const delay_model& model, const problem& p, double period, int interval,
                 const preferences& wanted) {
  attempt a;
  const delay_parameters& d = model.parameters();
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (p.is_settled()[id] && d.launch + p.node_delay(id) + d.capture > period + tolerance) {
      a.too_slow = id;
      return a;
    }
  }
  p.add_order(interval, wanted.apart, a.system.constraints);
  const std::vector<std::uint32_t> component = find_recurrences(a.system.constraints, p.count(), wanted.roomy);
  a.too_slow = p.add_chains(period, period * model.parameters().calm_share, component, a.system.constraints);
  if (a.too_slow != none) return a;
  p.add_distribution(component, a.system.constraints);
  a.system.build(p.count());
  a.stage = a.system.earliest(p.count(), a.cycle);
  return a;
}

/// What is preferred is given up where nothing else works.
attempt try_preferences(const graph& g, const delay_model& model, const problem& p, double period, int interval) {
  attempt a;
  for (const preferences& wanted : {preferences{}, preferences{.roomy = false}, preferences{false, false}}) {
    a = try_once(g, model, p, period, interval, wanted);
    if (a.feasible() || a.too_slow != none) break;
  }
  return a;
}

std::string describe_node(const graph& g, node_id id) {
  const node& n = g.nodes[id];
  unsigned width = n.width;
  if (!n.operands.empty()) width = std::max(width, g.nodes[n.operands.back()].width);
  std::string text =
      fmt::format("{}: {}, {} bit{}", describe(g, n.where), dataflow::name_of(n.kind), width, width == 1 ? "" : "s");
  std::string name = n.name;
  if (name.empty() && n.kind == operation::register_value) name = g.registers[n.object].name;
  if (name.empty() && (n.kind == operation::read || n.kind == operation::write)) name = g.ports[n.object].name;
  if (name.empty() && (n.kind == operation::memory_read || n.kind == operation::memory_write)) {
    name = g.memories[n.object].name;
  }
  if (!name.empty()) text += fmt::format(" ({})", name);
  return text;
}

[[noreturn]] void explain(const graph& g, const delay_model& model, const problem& p, const options& wanted,
                          const attempt& failed) {
  std::vector<chain_link> chain;
  double required = 0;
  source_location where;
  std::string text;
  bool at_issue = false;
  if (failed.too_slow != none) {
    const double delay = p.node_delay(failed.too_slow);
    chain.push_back({failed.too_slow, delay});
    required = delay + model.parameters().launch + model.parameters().capture;
    where = g.nodes[failed.too_slow].where;
    text = fmt::format("one operation takes longer than the period of {:.2f} ns", wanted.period);
  } else {
    const std::vector<constraint>& all = failed.system.constraints;
    bool through_memory = false;
    std::string memory_name, register_name;
    for (const std::uint32_t number : failed.cycle) {
      const constraint& c = all[number];
      at_issue |= c.from == 0 || c.to == 0;
      if (c.why == reason::memory) {
        through_memory = true;
        const node_id access = p.node_of(c.from);
        if (access != none && memory_name.empty()) memory_name = g.memories[g.nodes[access].object].name;
      }
      if (c.why == reason::recurrence && register_name.empty()) {
        register_name = g.registers[p.register_of_update(c.from)].name;
      }
      const auto is_listed = [&](node_id id) {
        return std::any_of(chain.begin(), chain.end(), [&](const chain_link& link) { return link.node == id; });
      };
      if (c.why == reason::chain) {
        std::vector<chain_link> part;
        required = std::max(required, p.trace(p.node_of(c.from), c.to, part));
        for (const chain_link& link : part) {
          if (!is_listed(link.node)) chain.push_back(link);
        }
      } else if (const node_id id = p.node_of(c.to); id != none && !is_listed(id)) {
        // Operations on the cycle that no chain contains; wires tell a reader nothing.
        const bool telling = !is_wire(g, id) || model.latency(g, id) > 0;
        if (telling) chain.push_back({id, p.node_delay(id)});
      }
    }
    for (const chain_link& link : chain) {
      if (where.line == 0) where = g.nodes[link.node].where;
    }
    // A read's condition is blamed on the read.
    if (at_issue) {
      node_id blamed = none;
      for (node_id id = 0; id < g.nodes.size() && blamed == none; ++id) {
        const node& n = g.nodes[id];
        if (n.kind != operation::read) continue;
        for (const chain_link& link : chain) {
          if (link.node == id || link.node == n.operands[0]) blamed = id;
        }
      }
      if (blamed != none) {
        where = g.nodes[blamed].where;
        text = fmt::format("the condition of reading '{}' cannot be decided in the first stage, in {:.2f} ns",
                           g.ports[g.nodes[blamed].object].name, wanted.period);
      } else {
        text = fmt::format("what decides the issue of an iteration does not fit into the first stage, into {:.2f} ns",
                           wanted.period);
      }
    } else {
      std::string what = "a recurrence";
      if (!register_name.empty()) {
        what += fmt::format(" through '{}'", register_name);
      } else if (through_memory && !memory_name.empty()) {
        what += fmt::format(" through memory '{}'", memory_name);
      }
      text = fmt::format("{} cannot close in {} clock{} of {:.2f} ns", what, wanted.initiation_interval,
                         wanted.initiation_interval == 1 ? "" : "s", wanted.period);
      if (through_memory && !memory_name.empty()) {
        text += fmt::format(" (memory '{}': promise a larger distance with #pragma HLS DEPENDENCE if the loop has one)",
                            memory_name);
      }
    }
  }

  // The smallest period: double until something fits, then halve the interval down to a hundredth of a nanosecond.
  const auto fits = [&](double period, int interval) {
    return try_preferences(g, model, p, period, interval).feasible();
  };
  double smallest_period = 0;
  double high = wanted.period * 2;
  while (high < wanted.period * 4096 && !fits(high, wanted.initiation_interval)) high *= 2;
  if (high < wanted.period * 4096) {
    double low = std::max(wanted.period, high / 2);
    while (high - low > 0.005) {
      const double middle = (low + high) / 2;
      (fits(middle, wanted.initiation_interval) ? high : low) = middle;
    }
    smallest_period = std::ceil(high * 100 - tolerance) / 100;
  }
  int smallest_interval = 0;
  if (failed.too_slow == none) {
    for (int n = wanted.initiation_interval + 1; n <= largest_interval && smallest_interval == 0; ++n) {
      if (fits(wanted.period, n)) smallest_interval = n;
    }
  }

  std::string full = fmt::format("{}: {}\n", describe(g, where), text);
  if (required > 0) full += fmt::format("  the chain takes {:.2f} ns from clock to clock:\n", required);
  for (const chain_link& link : chain) {
    full += fmt::format("    {}: {:.2f} ns", describe_node(g, link.node), link.delay);
    const int clocks = model.latency(g, link.node);
    if (clocks > 0) full += fmt::format(" and {} clocks", clocks);
    full += '\n';
  }
  full += smallest_period > 0
              ? fmt::format("  smallest period possible at an initiation interval of {}: {:.2f} ns\n",
                            wanted.initiation_interval, smallest_period)
              : fmt::format("  no period helps at an initiation interval of {}\n", wanted.initiation_interval);
  if (smallest_interval > 0) {
    full += fmt::format("  smallest initiation interval possible at {:.2f} ns: {}\n", wanted.period, smallest_interval);
  }
  throw infeasible(full, std::move(chain), where, required, smallest_period, smallest_interval);
}

attempt find_earliest(const graph& g, const delay_model& model, const problem& p, const options& wanted) {
  if (!(wanted.period > 0)) throw std::invalid_argument("the clock period must be positive");
  if (wanted.initiation_interval < 1) throw std::invalid_argument("the initiation interval must be at least 1");
  attempt a = try_preferences(g, model, p, wanted.period, wanted.initiation_interval);
  if (!a.feasible()) explain(g, model, p, wanted, a);
  return a;
}

/// Variables that every solution puts into one stage, as numbers 0, 1, ...; the origin gets 0.
std::vector<std::uint32_t> contract(const problem& p, const system_of_constraints& system, std::uint32_t& classes) {
  const std::uint32_t count = p.count();
  std::vector<char> rigid(count, 1);  // per component
  for (const constraint& c : system.constraints) {
    if (system.component[c.from] == system.component[c.to] && c.distance != 0) rigid[system.component[c.from]] = 0;
  }
  std::vector<std::uint32_t> of_component(count, none), of_variable(count);
  classes = 0;
  for (variable v = 0; v < count; ++v) {
    const std::uint32_t component = system.component[v];
    if (!rigid[component]) {
      of_variable[v] = classes++;
      continue;
    }
    if (of_component[component] == none) of_component[component] = classes++;
    of_variable[v] = of_component[component];
  }
  return of_variable;
}

}  // namespace

std::string describe(const graph& g, source_location where) {
  if (where.line == 0 || where.file >= g.files.size()) return "unknown line";
  return fmt::format("{}:{}", g.files[where.file], where.line);
}

bool is_settled_register(const graph& g, const result& s, node_id id) {
  return s.stage[id] == settled && !is_wire(g, id);
}

std::vector<use> uses(const graph& g, const result& s) {
  std::vector<use> all;
  const auto note = [&](node_id value, int stage, register_id enables = none) {
    if (s.stage[value] != settled) all.push_back({value, stage, enables});
  };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (s.stage[id] == settled) continue;
    for (const node_id operand : g.nodes[id].operands) note(operand, s.stage[id]);
  }
  for (register_id r = 0; r < g.registers.size(); ++r) {
    note(g.registers[r].next, s.register_update[r]);
    note(g.registers[r].enable, s.register_update[r], r);
  }
  return all;
}

std::vector<recurrence_delay> recurrences(const graph& g, const delay_model& model, const result& s) {
  // Registers whose value reaches each other lie in one component; chains inside the component are its loop.
  const problem p(g, model);
  system_of_constraints system;
  p.add_order(s.initiation_interval, false, system.constraints);
  system.build(p.count());
  std::vector<double> at(g.nodes.size(), -1);  // arrival along the component only
  const auto component = [&](node_id id) { return system.component[p.of_node(id)]; };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (s.stage[id] == settled) continue;
    const node& n = g.nodes[id];
    if (n.kind == operation::register_value) {
      at[id] = model.parameters().launch;
      continue;
    }
    for (std::size_t i = 0; i < n.operands.size(); ++i) {
      const node_id operand = n.operands[i];
      if (s.stage[operand] == settled || at[operand] < 0 || component(operand) != component(id)) continue;
      at[id] = std::max(at[id], at[operand] + model.entry(g, id, i) + p.node_delay(id));
    }
  }
  std::vector<recurrence_delay> all;
  for (register_id r = 0; r < g.registers.size(); ++r) {
    if (s.register_stage[r] == settled) continue;
    double delay = -1;
    const auto end = [&](node_id id, double entry) {
      if (s.stage[id] == settled || at[id] < 0 || g.nodes[id].kind == operation::register_value) return;
      if (component(id) == system.component[p.of_register(r)]) delay = std::max(delay, at[id] + entry);
    };
    end(g.registers[r].next, 0);
    end(g.registers[r].enable, model.enable_entry());
    if (delay >= 0) all.push_back({r, delay + model.parameters().capture});
  }
  return all;
}

result make_schedule(const graph& g, const delay_model& model, const options& wanted) {
  const problem p(g, model);
  const attempt a = find_earliest(g, model, p, wanted);

  std::uint32_t classes = 0;
  const std::vector<std::uint32_t> class_of = contract(p, a.system, classes);
  std::vector<difference_constraint> constraints;
  for (const constraint& c : a.system.constraints) {
    if (class_of[c.from] != class_of[c.to]) constraints.push_back({class_of[c.from], class_of[c.to], c.distance});
  }
  // The longest wait of every value is what it costs; one variable a value with several users stands for the last.
  struct demand {
    std::uint32_t value_class;
    node_id value;
    std::uint32_t user_class;
  };
  std::vector<demand> demands;
  const auto note = [&](node_id value, variable user) {
    if (!p.is_settled()[value]) demands.push_back({class_of[p.of_node(value)], value, class_of[user]});
  };
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (p.is_settled()[id]) continue;
    for (const node_id operand : g.nodes[id].operands) note(operand, p.of_node(id));
  }
  for (register_id r = 0; r < g.registers.size(); ++r) {
    note(g.registers[r].next, p.of_update(r));
    note(g.registers[r].enable, p.of_update(r));
  }
  std::sort(demands.begin(), demands.end(), [](const demand& x, const demand& y) {
    return std::pair(x.value, x.user_class) < std::pair(y.value, y.user_class);
  });
  std::vector<std::int64_t> weights(classes, 0);
  for (std::size_t begin = 0; begin < demands.size();) {
    const demand& d = demands[begin];
    const auto price = static_cast<std::int64_t>(g.nodes[d.value].width);
    std::vector<std::uint32_t> users;
    std::size_t end = begin;
    for (; end < demands.size() && demands[end].value == d.value; ++end) {
      if (users.empty() || users.back() != demands[end].user_class) users.push_back(demands[end].user_class);
    }
    std::uint32_t last = users[0];
    if (users.size() > 1) {
      last = static_cast<std::uint32_t>(weights.size());
      weights.push_back(0);
      for (const std::uint32_t user : users) constraints.push_back({user, last, 0});
    }
    weights[last] += price;
    weights[d.value_class] -= price;
    begin = end;
  }
  weights[class_of[p.end()]] += static_cast<std::int64_t>(stage_price);
  weights[0] -= static_cast<std::int64_t>(stage_price);

  // Of several constraints between two classes the widest is enough.
  std::sort(constraints.begin(), constraints.end(), [](const difference_constraint& x, const difference_constraint& y) {
    if (x.from != y.from) return x.from < y.from;
    if (x.to != y.to) return x.to < y.to;
    return x.distance > y.distance;
  });
  constraints.erase(std::unique(constraints.begin(), constraints.end(),
                                [](const difference_constraint& x, const difference_constraint& y) {
                                  return x.from == y.from && x.to == y.to;
                                }),
                    constraints.end());

  std::vector<int> stage = a.stage;
  std::vector<std::int64_t> values;
  if (!solve_difference_program(weights, constraints, values)) {
    throw std::logic_error("the schedule's linear program has no optimum although an earliest schedule exists");
  }
  for (variable v = 0; v < p.count(); ++v) stage[v] = static_cast<int>(values[class_of[v]]);
  result s;
  s.period = wanted.period;
  s.initiation_interval = wanted.initiation_interval;
  fill(g, model, p, stage, s);
  find_critical_chain(g, model, s);
  return s;
}

result make_random_schedule(const graph& g, const delay_model& model, const options& wanted, std::uint64_t seed) {
  const problem p(g, model);
  attempt a = find_earliest(g, model, p, wanted);
  // Slack between components never contradicts anything.
  std::mt19937_64 random(seed);
  for (constraint& c : a.system.constraints) {
    const bool between = a.system.component[c.from] != a.system.component[c.to];
    if (between && c.to != p.end() && random() % 4 == 0) c.distance += static_cast<int>(random() % 3);
  }
  result s;
  s.period = wanted.period;
  s.initiation_interval = wanted.initiation_interval;
  fill(g, model, p, a.system.earliest(p.count(), a.cycle), s);
  find_critical_chain(g, model, s);
  return s;
}

std::string validate(const graph& g, const delay_model& model, const result& s) {
  const std::size_t count = g.nodes.size();
  if (s.stage.size() != count || s.available.size() != count || s.settle_level.size() != count ||
      s.register_stage.size() != g.registers.size() || s.register_update.size() != g.registers.size()) {
    return "the schedule is of another graph";
  }
  const auto complain = [&](node_id id, const std::string& text) {
    return fmt::format("node {} ({}): {}", id, dataflow::name_of(g.nodes[id].kind), text);
  };
  const auto settled_or_at = [&](node_id value, int stage) {
    return s.stage[value] == settled || s.available[value] <= stage;
  };
  int settle = 0;
  std::vector<int> last_settled_use(count, -1);
  bool any_patient = false;
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (s.stage[id] == settled) {
      const bool movable = n.kind != operation::read && n.kind != operation::write &&
                           n.kind != operation::memory_read && n.kind != operation::memory_write;
      if (!movable) return complain(id, "an access cannot be settled");
      if (n.kind == operation::register_value && (g.patient == none || !g.registers[n.object].patient)) {
        return complain(id, "the register is not patient, so its value is not settled");
      }
      int level = 0;
      for (const node_id operand : n.operands) {
        if (s.stage[operand] != settled) return complain(id, "settled, but an operand is not");
        level = std::max(level, s.settle_level[operand]);
      }
      if (s.settle_level[id] < level + (is_settled_register(g, s, id) ? 1 : 0))
        return complain(id, "settles too early");
      settle = std::max(settle, s.settle_level[id]);
      continue;
    }
    if (s.stage[id] < 0 || s.available[id] >= s.depth) return complain(id, "outside the pipeline");
    if (s.available[id] != s.stage[id] + model.latency(g, id)) return complain(id, "wrong latency");
    for (const node_id operand : n.operands) {
      if (!settled_or_at(operand, s.stage[id])) return complain(id, fmt::format("works before operand {}", operand));
      if (s.stage[operand] == settled) last_settled_use[operand] = std::max(last_settled_use[operand], s.stage[id]);
    }
    if (n.kind == operation::read && s.stage[id] != 0) return complain(id, "a read outside stage 0");
    if (n.kind == operation::register_value && s.stage[id] != s.register_stage[n.object]) {
      return complain(id, "not in its register's stage");
    }
  }
  if (g.patient != none && !settled_or_at(g.patient, 0)) return complain(g.patient, "the patient mark is late");
  for (register_id r = 0; r < g.registers.size(); ++r) {
    const dataflow::register_state& state = g.registers[r];
    const int update = s.register_update[r];
    for (const node_id source : {state.next, state.enable}) {
      if (!settled_or_at(source, update)) return fmt::format("register {}: updated before its input is there", r);
      if (s.stage[source] == settled) last_settled_use[source] = std::max(last_settled_use[source], update);
    }
    if (update < 0 || update >= s.depth) return fmt::format("register {}: updated outside the pipeline", r);
    if (g.patient != none && state.patient) {
      any_patient = true;
      if (update >= s.commit) return fmt::format("register {}: committed before its next value is there", r);
      continue;
    }
    const int late = update - s.register_stage[r];
    if (late < 0 || late >= s.initiation_interval) return fmt::format("register {}: its recurrence does not close", r);
  }
  for (node_id id = 0; id < count; ++id) {
    if (any_patient && g.nodes[id].kind != operation::constant && last_settled_use[id] > s.commit) {
      return complain(id, "a settled value changes while an iteration uses it");
    }
  }
  if (any_patient && s.hold < s.commit + settle) return "iterations are issued before settled values are right";
  std::vector<int> port_stage(g.ports.size(), -1);
  std::vector<int> first_read(g.memories.size(), INT32_MAX), last_read(g.memories.size(), -1);
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (n.kind == operation::write) {
      if (port_stage[n.object] >= 0 && port_stage[n.object] != s.stage[id]) return complain(id, "port's stages differ");
      port_stage[n.object] = s.stage[id];
    }
    if (n.kind == operation::memory_read) {
      first_read[n.object] = std::min(first_read[n.object], s.stage[id]);
      last_read[n.object] = std::max(last_read[n.object], s.stage[id]);
    }
  }
  std::vector<int> write_stage(g.memories.size(), -1);
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::memory_write) continue;
    const std::int64_t window = static_cast<std::int64_t>(g.memories[n.object].distance) * s.initiation_interval - 1;
    if (last_read[n.object] > s.stage[id]) return complain(id, "written before an earlier iteration's read");
    if (last_read[n.object] >= 0 && s.stage[id] - first_read[n.object] > window) {
      return complain(id, "written too late for a later iteration's read");
    }
    if (write_stage[n.object] >= 0 && write_stage[n.object] != s.stage[id]) {
      return complain(id, "another write to the memory is in another stage");
    }
    write_stage[n.object] = s.stage[id];
  }
  const timing t = analyse(g, model, s);
  if (t.worst > s.period + 2 * tolerance) {
    return complain(t.worst_end, fmt::format("its chain takes {:.2f} ns of {:.2f} ns", t.worst, s.period));
  }
  return {};
}

}  // namespace epiline::schedule
