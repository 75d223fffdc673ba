#include "schedule/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "schedule/timing.hpp"

namespace epiline::schedule {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::source_location;

namespace {

constexpr int largest_interval = 64;

/// What is wrong, and the operations that make it so.
struct blame {
  std::string text;
  std::vector<chain_link> chain;
  double required = 0;  // nanoseconds from clock to clock; 0 when clocks are lacking, not nanoseconds
  source_location where;
};

blame blame_operation(const graph& g, const delay_model& model, const options& wanted, node_id too_slow) {
  const double delay = model.delay(g, too_slow);
  return {fmt::format("one operation takes longer than the period of {:.2f} ns", wanted.period),
          {{too_slow, delay}},
          delay + model.parameters().launch + model.parameters().capture,
          g.nodes[too_slow].where};
}

/// A read's condition is blamed on the read.
void blame_issue(const graph& g, const options& wanted, blame& found) {
  node_id blamed = none;
  for (node_id id = 0; id < g.nodes.size() && blamed == none; ++id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::read) continue;
    for (const chain_link& link : found.chain) {
      if (link.node == id || link.node == n.operands[0]) blamed = id;
    }
  }
  if (blamed != none) {
    found.where = g.nodes[blamed].where;
    found.text = fmt::format("the condition of reading '{}' cannot be decided in the first stage, in {:.2f} ns",
                             g.ports[g.nodes[blamed].object].name, wanted.period);
  } else {
    found.text = fmt::format("what decides the issue of an iteration does not fit into the first stage, into {:.2f} ns",
                             wanted.period);
  }
}

/// Blames the contradicting constraints of an attempt.
blame blame_cycle(const graph& g, const delay_model& model, const attempts& all, const options& wanted,
                  const attempt& failed) {
  const problem& p = all.rules();
  blame found;
  bool at_issue = false;
  bool through_memory = false;
  std::string memory_name, register_name;
  for (const std::uint32_t number : failed.cycle) {
    const constraint& c = failed.system.constraints[number];
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
      return std::any_of(found.chain.begin(), found.chain.end(),
                         [&](const chain_link& link) { return link.node == id; });
    };
    if (c.why == reason::chain) {
      std::vector<chain_link> part;
      found.required = std::max(found.required, all.ways().trace(p.node_of(c.from), c.to, part));
      for (const chain_link& link : part) {
        if (!is_listed(link.node)) found.chain.push_back(link);
      }
    } else if (const node_id id = p.node_of(c.to); id != none && !is_listed(id)) {
      // Operations on the cycle that no chain contains; wires tell a reader nothing.
      const bool telling = !is_wire(g, id) || model.latency(g, id) > 0;
      if (telling) found.chain.push_back({id, model.delay(g, id)});
    }
  }
  for (const chain_link& link : found.chain) {
    if (found.where.line == 0) found.where = g.nodes[link.node].where;
  }
  if (at_issue) {
    blame_issue(g, wanted, found);
    return found;
  }
  std::string what = "a recurrence";
  if (!register_name.empty()) {
    what += fmt::format(" through '{}'", register_name);
  } else if (through_memory && !memory_name.empty()) {
    what += fmt::format(" through memory '{}'", memory_name);
  }
  found.text = fmt::format("{} cannot close in {} clock{} of {:.2f} ns", what, wanted.initiation_interval,
                           wanted.initiation_interval == 1 ? "" : "s", wanted.period);
  if (through_memory && !memory_name.empty()) {
    found.text += fmt::format(
        " (memory '{}': promise a larger distance with #pragma HLS DEPENDENCE if the loop has one)", memory_name);
  }
  return found;
}

/// Nanoseconds; 0 when no period helps.
double find_smallest_period(const attempts& all, const options& wanted) {
  const auto fits = [&](double period) { return all.at(period, wanted.initiation_interval).feasible(); };
  // Double until something fits, then halve the interval down to a hundredth of a nanosecond.
  double high = wanted.period * 2;
  while (high < wanted.period * 4096 && !fits(high)) high *= 2;
  if (high >= wanted.period * 4096) return 0;
  double low = std::max(wanted.period, high / 2);
  while (high - low > 0.005) {
    const double middle = (low + high) / 2;
    (fits(middle) ? high : low) = middle;
  }
  return std::ceil(high * 100 - tolerance) / 100;
}

/// 0 when no interval helps.
int find_smallest_interval(const attempts& all, const options& wanted) {
  for (int n = wanted.initiation_interval + 1; n <= largest_interval; ++n) {
    if (all.at(wanted.period, n).feasible()) return n;
  }
  return 0;
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

}  // namespace

void explain(const graph& g, const delay_model& model, const attempts& all, const options& wanted,
             const attempt& failed) {
  const bool is_one_operation = failed.too_slow != none;
  blame found = is_one_operation ? blame_operation(g, model, wanted, failed.too_slow)
                                 : blame_cycle(g, model, all, wanted, failed);
  const double smallest_period = find_smallest_period(all, wanted);
  const int smallest_interval = is_one_operation ? 0 : find_smallest_interval(all, wanted);

  std::string full = fmt::format("{}: {}\n", describe(g, found.where), found.text);
  if (found.required > 0) {
    full += fmt::format("  the chain takes {:.2f} ns from clock to clock:\n", found.required);
  }
  for (const chain_link& link : found.chain) {
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
  throw infeasible(full, std::move(found.chain), found.where, found.required, smallest_period, smallest_interval);
}

}  // namespace epiline::schedule
