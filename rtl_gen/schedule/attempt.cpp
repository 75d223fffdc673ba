#include "schedule/attempt.hpp"

#include <utility>

#include "schedule/timing.hpp"

namespace epiline::schedule {

using dataflow::node_id;
using dataflow::none;

namespace {

/// Recurrences: what chains of operations hold together, by variable. A `roomy` memory, whose words come again so late
/// that there is time for registers between its words and what is written, holds nothing together.
std::vector<std::uint32_t> find_recurrences(const std::vector<constraint>& order, std::uint32_t count, bool roomy) {
  constexpr int room = 4;  // stages from the read to the write: two for the RAM, and some for registers
  constraint_system tight;
  for (const constraint& c : order)
    if (!roomy || c.why != reason::memory || c.distance > -room) tight.constraints.push_back(c);
  tight.build(count);
  return std::move(tight.component);
}

}  // namespace

attempt attempts::try_once(double period, int interval, const preferences& wanted) const {
  attempt a;
  const delay_parameters& d = model_.parameters();
  for (node_id id = 0; id < g_.nodes.size(); ++id) {
    if (p_.is_settled()[id] && d.launch + model_.delay(g_, id) + d.capture > period + tolerance) {
      a.too_slow = id;
      return a;
    }
  }
  p_.add_order(interval, wanted.apart, a.system.constraints);
  const std::vector<std::uint32_t> component = find_recurrences(a.system.constraints, p_.count(), wanted.roomy);
  a.too_slow = chains_.add_chains(period, period * d.calm_share, component, a.system.constraints);
  if (a.too_slow != none) return a;
  chains_.add_distribution(component, a.system.constraints);
  a.system.build(p_.count());
  a.stage = a.system.earliest(p_.count(), a.cycle);
  return a;
}

attempt attempts::at(double period, int interval) const {
  attempt a;
  for (const preferences& wanted : {preferences{}, preferences{.roomy = false}, preferences{false, false}}) {
    a = try_once(period, interval, wanted);
    if (a.feasible() || a.too_slow != none) break;
  }
  return a;
}

}  // namespace epiline::schedule
