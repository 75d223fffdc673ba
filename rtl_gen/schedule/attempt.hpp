#pragma once
// The earliest schedule at a period and an interval, if there is one: preferences are tried, and given up where nothing
// else works.

#include <cstdint>
#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/chains.hpp"
#include "schedule/constraint_system.hpp"
#include "schedule/delay_model.hpp"
#include "schedule/problem.hpp"

namespace epiline::schedule {

/// Constraints for a period and an interval, and their earliest solution.
struct attempt {
  constraint_system system;
  std::vector<int> stage;                       // per variable; empty when there is none
  std::vector<std::uint32_t> cycle;             // the contradiction: numbers of constraints
  dataflow::node_id too_slow = dataflow::none;  // a node that alone exceeds the period

  [[nodiscard]] bool feasible() const { return !stage.empty(); }
};

/// What a graph's attempts at different periods and intervals have in common.
class attempts {
 public:
  attempts(const dataflow::graph& g, const delay_model& model)
      : g_(g), model_(model), p_(g, model), chains_(g, model, p_) {}
  attempts(const attempts&) = delete;
  attempts& operator=(const attempts&) = delete;

  [[nodiscard]] const problem& rules() const { return p_; }
  [[nodiscard]] const chains& ways() const { return chains_; }

  /// The attempt at `period` nanoseconds and one iteration every `interval` clocks.
  [[nodiscard]] attempt at(double period, int interval) const;

 private:
  struct preferences {
    bool apart =
        true;  // writes a stage after the reads of the same memory: block RAMs then never meet both of one word
    bool roomy = true;  // registers between a memory's words and what is written
  };
  [[nodiscard]] attempt try_once(double period, int interval, const preferences& wanted) const;

  const dataflow::graph& g_;
  const delay_model& model_;
  problem p_;
  chains chains_;
};

}  // namespace epiline::schedule
