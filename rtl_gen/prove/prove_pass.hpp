#pragma once
// Proves that a pass kept what one iteration of a graph does: equal tokens taken and given, and a state that is related
// again (relation.hpp), from every related state and for every token.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::prove {

enum class verdict : std::uint8_t {
  proved,
  timed_out,
  refuted,
  not_covered,  // the pass changed the state in a way that relation.hpp does not state
};
[[nodiscard]] const char* name_of(verdict v);

/// A start of an iteration from which the two graphs differ.
struct counterexample {
  std::string what;   // differs
  std::string place;  // FILE:LINE in the source; empty if unknown
  /// The names and values of registers ("register NAME"), words read ("memory NAME[INDEX]") and tokens ("token NAME")
  /// of the graph before the pass, in hexadecimal; those that what differs depends on.
  std::vector<std::pair<std::string, std::string>> start;
  /// Whether the interpreter of dataflow/interpreter.hpp, started there, comes to differing results as well.
  bool confirmed = false;
};

struct proof {
  std::string pass;
  verdict result = verdict::proved;
  std::string relation;                      // what the states were taken to have in common
  std::string reason;                        // of not_covered
  unsigned obligations = 0;                  // outputs, registers and memories that had to be compared
  unsigned unproved = 0;                     // of them, when the time was over
  bool with_facts = false;                   // what is known about ranges was needed, and proved too
  double seconds = 0;                        // of the processor
  std::optional<counterexample> difference;  // of refuted
};

struct options {
  double seconds = 10;  // of the processor, for a pass
};

/// The graphs keep the rules of graph.hpp; the objects of `after` have their `origin` in `before`.
[[nodiscard]] proof prove_pass(const std::string& pass, const dataflow::graph& before, const dataflow::graph& after,
                               const options& given = {});

/// "4.8.12"
[[nodiscard]] std::string solver_version();

}  // namespace epiline::prove
