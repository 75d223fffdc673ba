#pragma once
// Which clock of an iteration every operation works in.
//
// An iteration issued in clock t has its stage s in clock t + s; a new iteration may be issued every
// `initiation_interval` clocks. A stage's logic starts at flip-flops and ends at flip-flops, so the chain of operations
// in one stage has to fit into the period.
//
// "Settled" values (constants, patient registers and what is computed from these alone) have no stage: they change only
// while no iteration is in flight, so every stage may use them directly and nothing has to be delayed.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "schedule/delay_model.hpp"

namespace epiline::schedule {

/// Instead of a stage: the value is settled.
inline constexpr int settled = -1;

struct options {
  double period = 6.0;  // nanoseconds
  int initiation_interval = 1;
};

/// One operation of a chain, in the order the signal passes.
struct chain_link {
  dataflow::node_id node = dataflow::none;
  double delay = 0;  // nanoseconds this operation adds
};

struct result {
  double period = 0;
  int initiation_interval = 1;
  std::vector<int> stage;            // per node: where it is computed, or `settled`
  std::vector<int> available;        // per node: first stage that can use the result (after a block RAM's latency)
  std::vector<int> register_stage;   // per register: where its old value is read, or `settled`
  std::vector<int> register_update;  // per register: the stage at whose end it takes its next value; for a patient
                                     // register, the stage at whose end the next value is put by until `commit`
  std::vector<int> settle_level;     // per settled node: clocks from a patient register's change to the right value
  int depth = 1;                     // number of stages
  int commit = 0;                    // stage at whose end patient registers change
  int hold = 0;                      // clocks without an issue that follow an iteration marked by graph::patient
  std::vector<chain_link> critical_chain;
  double critical_delay = 0;        // nanoseconds, from clock to clock
  std::uint64_t pipeline_bits = 0;  // bits times stages that values wait for their users
};

/// No schedule exists for this period and interval. what() is the whole explanation for a person.
class infeasible : public std::runtime_error {
 public:
  infeasible(const std::string& text, std::vector<chain_link> chain, dataflow::source_location where,
             double required_period, double smallest_period, int smallest_interval)
      : std::runtime_error(text),
        chain_(std::move(chain)),
        where_(where),
        required_period_(required_period),
        smallest_period_(smallest_period),
        smallest_interval_(smallest_interval) {}

  /// The operations that limit, in signal order.
  [[nodiscard]] const std::vector<chain_link>& chain() const { return chain_; }
  /// The source line to blame first.
  [[nodiscard]] dataflow::source_location where() const { return where_; }
  /// Nanoseconds the chain takes from clock to clock; 0 when clocks are lacking, not nanoseconds.
  [[nodiscard]] double required_period() const { return required_period_; }
  /// Smallest period, in nanoseconds, for which a schedule at the same interval exists; 0: none does.
  [[nodiscard]] double smallest_period() const { return smallest_period_; }
  /// Smallest initiation interval for which a schedule at the same period exists; 0: none up to 64 does.
  [[nodiscard]] int smallest_interval() const { return smallest_interval_; }

 private:
  std::vector<chain_link> chain_;
  dataflow::source_location where_;
  double required_period_;
  double smallest_period_;
  int smallest_interval_;
};

/// The schedule with the fewest pipeline register bits. The graph must obey find_violation().
/// Throws `infeasible`; std::invalid_argument for a period that is not positive or an interval below 1.
[[nodiscard]] result make_schedule(const dataflow::graph& g, const delay_model& model, const options& wanted);

/// A legal schedule with random slack, to test that results do not depend on the schedule. Throws as make_schedule().
[[nodiscard]] result make_random_schedule(const dataflow::graph& g, const delay_model& model, const options& wanted,
                                          std::uint64_t seed);

/// Checks every rule independently of how a schedule was found. Returns an empty string, or one sentence.
[[nodiscard]] std::string validate(const dataflow::graph& g, const delay_model& model, const result& s);

/// True when the settled node `id` is computed by logic, whose result a flip-flop of its own takes every clock.
[[nodiscard]] bool is_settled_register(const dataflow::graph& g, const result& s, dataflow::node_id id);

/// A stage that needs the value of a node, per use.
struct use {
  dataflow::node_id value = dataflow::none;
  int stage = 0;
  bool enables = false;  // the value decides whether a register is updated, or a memory written
};
/// Every use of a value that is not settled, by stage: operands, registers' next values and enables.
[[nodiscard]] std::vector<use> uses(const dataflow::graph& g, const result& s);

/// The slowest way from a register's value to its own next value or enable, from clock to clock.
struct recurrence_delay {
  dataflow::register_id state = dataflow::none;
  double delay = 0;  // nanoseconds
};
/// Every register on a loop with operations in it, by number, as scheduled. Exact for loops of one register; for a loop
/// through several registers each one is listed with the part of the loop that ends in it.
[[nodiscard]] std::vector<recurrence_delay> recurrences(const dataflow::graph& g, const delay_model& model,
                                                        const result& s);

/// "file.cpp:12" or "unknown line".
[[nodiscard]] std::string describe(const dataflow::graph& g, dataflow::source_location where);

}  // namespace epiline::schedule
