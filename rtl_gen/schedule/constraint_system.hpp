#pragma once
// Rules of the form stage[to] - stage[from] >= distance, and the earliest stages that keep them all. Knows nothing of
// graphs: what a variable stands for is problem.hpp's.

#include <cstdint>
#include <vector>

namespace epiline::schedule {

/// Whose stage it is, by number; variable 0 is the origin, which is in stage 0.
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

/// Constraints indexed by the variable they start from, and their components.
struct constraint_system {
  std::vector<constraint> constraints;
  std::vector<std::uint32_t> first;     // per variable, into `outgoing`
  std::vector<std::uint32_t> outgoing;  // constraint numbers
  /// Per variable: its strongly connected component, whose stages depend on each other in both directions. Numbered so
  /// that constraints lead from higher numbers to lower ones.
  std::vector<std::uint32_t> component;

  /// Makes everything else of `constraints`, over `count` variables.
  void build(std::uint32_t count);

  /// Earliest stages of all variables. Returns an empty vector and the contradicting cycle, as numbers of constraints
  /// in their order, when there are none.
  [[nodiscard]] std::vector<int> earliest(std::uint32_t count, std::vector<std::uint32_t>& cycle) const;

 private:
  bool find_cycle(const std::vector<variable>& order, std::size_t begin, std::size_t end,
                  const std::vector<std::uint32_t>& cause, std::vector<std::uint32_t>& mark,
                  std::vector<std::uint32_t>& cycle) const;
};

}  // namespace epiline::schedule
