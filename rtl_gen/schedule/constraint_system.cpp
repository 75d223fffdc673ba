#include "schedule/constraint_system.hpp"

#include <algorithm>
#include <limits>

namespace epiline::schedule {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Strongly connected components by Tarjan's algorithm, without recursion: a chain may be as long
/// as the design is deep.
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

}  // namespace

void constraint_system::build(std::uint32_t count) {
  first.assign(count + 1, 0);
  for (const constraint& c : constraints) ++first[c.from + 1];
  for (std::uint32_t v = 0; v < count; ++v) first[v + 1] += first[v];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  outgoing.resize(constraints.size());
  for (std::uint32_t i = 0; i < constraints.size(); ++i) outgoing[next[constraints[i].from]++] = i;
  component = find_components(count, constraints, first, outgoing);
}

std::vector<int> constraint_system::earliest(std::uint32_t count, std::vector<std::uint32_t>& cycle) const {
  std::vector<variable> order(count);
  for (variable v = 0; v < count; ++v) order[v] = v;
  std::sort(order.begin(), order.end(),
            [&](variable a, variable b) { return component[a] != component[b] ? component[a] > component[b] : a < b; });
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

/// A cycle among the constraints that raised the variables last has a positive sum.
bool constraint_system::find_cycle(const std::vector<variable>& order, std::size_t begin, std::size_t end,
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

}  // namespace epiline::schedule
