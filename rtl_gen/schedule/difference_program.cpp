#include "difference_program.hpp"

#include <lemon/network_simplex.h>
#include <lemon/static_graph.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace epiline::schedule {

bool solve_difference_program(const std::vector<std::int64_t>& weights,
                              const std::vector<difference_constraint>& constraints,
                              std::vector<std::int64_t>& values) {
  // One flow arc a constraint, its cost the negated distance; the potentials of an optimal flow are the solution.
  std::vector<difference_constraint> sorted = constraints;
  std::sort(sorted.begin(), sorted.end(), [](const difference_constraint& a, const difference_constraint& b) {
    return std::tie(a.from, a.to, a.distance) < std::tie(b.from, b.to, b.distance);
  });
  std::vector<std::pair<int, int>> arcs;
  arcs.reserve(sorted.size());
  for (const difference_constraint& c : sorted) arcs.emplace_back(static_cast<int>(c.from), static_cast<int>(c.to));
  lemon::StaticDigraph flow;
  flow.build(static_cast<int>(weights.size()), arcs.begin(), arcs.end());
  lemon::StaticDigraph::ArcMap<std::int64_t> cost(flow);
  for (std::size_t i = 0; i < sorted.size(); ++i) cost[flow.arc(static_cast<int>(i))] = -sorted[i].distance;
  lemon::StaticDigraph::NodeMap<std::int64_t> supply(flow);
  for (std::size_t i = 0; i < weights.size(); ++i) supply[flow.node(static_cast<int>(i))] = -weights[i];

  using simplex_type = lemon::NetworkSimplex<lemon::StaticDigraph, std::int64_t, std::int64_t>;
  simplex_type simplex(flow);
  simplex.costMap(cost).supplyMap(supply);
  if (simplex.run() != simplex_type::OPTIMAL) return false;
  values.resize(weights.size());
  const std::int64_t origin = weights.empty() ? 0 : simplex.potential(flow.node(0));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    values[i] = origin - simplex.potential(flow.node(static_cast<int>(i)));
  }
  return true;
}

}  // namespace epiline::schedule
