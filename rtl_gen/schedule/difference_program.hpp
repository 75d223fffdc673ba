#pragma once
// Linear programs whose constraints are differences of two variables: the dual of a min-cost flow.

#include <cstdint>
#include <vector>

namespace epiline::schedule {

/// value[to] - value[from] >= distance
struct difference_constraint {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::int64_t distance = 0;
};

/// Minimises sum(weights[i] * value[i]) under the constraints, by the network simplex on the dual flow. The weights
/// must add up to zero (only differences of variables are priced). The values come out integral, with value[0] = 0.
/// Returns false when the constraints contradict each other or the minimum is unbounded; `values` is then unspecified.
[[nodiscard]] bool solve_difference_program(const std::vector<std::int64_t>& weights,
                                            const std::vector<difference_constraint>& constraints,
                                            std::vector<std::int64_t>& values);

}  // namespace epiline::schedule
