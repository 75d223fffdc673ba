#include "schedule/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "schedule/attempt.hpp"
#include "schedule/difference_program.hpp"
#include "schedule/explain.hpp"
#include "schedule/problem.hpp"
#include "schedule/reset_gates.hpp"
#include "schedule/result.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node_id;
using dataflow::none;
using dataflow::register_id;
using dataflow::source_location;

namespace {

constexpr double stage_price = 4;  // bits that one more stage costs by itself: its valid bit, its share of the FIFOs

attempt find_earliest(const graph& g, const delay_model& model, const attempts& all, const options& wanted) {
  if (!(wanted.period > 0)) throw std::invalid_argument("the clock period must be positive");
  if (wanted.initiation_interval < 1) throw std::invalid_argument("the initiation interval must be at least 1");
  attempt a = all.at(wanted.period, wanted.initiation_interval);
  if (!a.feasible()) explain(g, model, all, wanted, a);
  return a;
}

/// Variables that every solution puts into one stage, as numbers 0, 1, ...; the origin gets 0.
std::vector<std::uint32_t> contract(const problem& p, const constraint_system& system, std::uint32_t& classes) {
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

/// What the waiting of values costs: a weight for every class, and for the variables that it adds behind them. They add
/// up to zero.
std::vector<std::int64_t> find_prices(const graph& g, const problem& p, const std::vector<std::uint32_t>& class_of,
                                      std::uint32_t classes, std::vector<difference_constraint>& constraints) {
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
  return weights;
}

/// Of several constraints between two classes the widest is enough.
void keep_widest(std::vector<difference_constraint>& constraints) {
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
}

}  // namespace

std::string describe(const graph& g, source_location where) {
  if (where.line == 0 || where.file >= g.files.size()) return "unknown line";
  return fmt::format("{}:{}", g.files[where.file], where.line);
}

result make_schedule(const graph& g, const delay_model& model, const options& wanted) {
  const attempts all(g, model);
  const problem& p = all.rules();
  attempt a = find_earliest(g, model, all, wanted);
  ask_for_early_conditions(g, p, a);

  std::uint32_t classes = 0;
  const std::vector<std::uint32_t> class_of = contract(p, a.system, classes);
  std::vector<difference_constraint> constraints;
  for (const constraint& c : a.system.constraints) {
    if (class_of[c.from] != class_of[c.to]) constraints.push_back({class_of[c.from], class_of[c.to], c.distance});
  }
  const std::vector<std::int64_t> weights = find_prices(g, p, class_of, classes, constraints);
  keep_widest(constraints);

  std::vector<std::int64_t> values;
  if (!solve_difference_program(weights, constraints, values)) {
    throw std::logic_error("the schedule's linear program has no optimum although an earliest schedule exists");
  }
  std::vector<int> stage(p.count());
  for (variable v = 0; v < p.count(); ++v) stage[v] = static_cast<int>(values[class_of[v]]);
  move_gates_to_flip_flops(g, model, p, make_result(g, model, wanted, p, stage), stage);
  return make_result(g, model, wanted, p, stage);
}

result make_random_schedule(const graph& g, const delay_model& model, const options& wanted, std::uint64_t seed) {
  const attempts all(g, model);
  const problem& p = all.rules();
  attempt a = find_earliest(g, model, all, wanted);
  // Slack between components never contradicts anything.
  // The name counts as well: what is compiled with one seed, tops and processes, has draws of its own.
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  words.insert(words.end(), g.name.begin(), g.name.end());
  std::seed_seq mixed(words.begin(), words.end());
  std::mt19937_64 random(mixed);
  for (constraint& c : a.system.constraints) {
    const bool between = a.system.component[c.from] != a.system.component[c.to];
    if (between && c.to != p.end() && random() % 4 == 0) c.distance += static_cast<int>(random() % 3);
  }
  return make_result(g, model, wanted, p, a.system.earliest(p.count(), a.cycle));
}

}  // namespace epiline::schedule
