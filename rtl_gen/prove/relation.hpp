#pragma once
// How the state of a graph before a pass and the state after it belong together: what is assumed of the start of an
// iteration, and what must hold again at its end. The passes' own analyses only propose it; whether it holds from
// iteration to iteration is for the solver to say.
//
// What is related: a register or memory with what became of it (register_state::origin, memory::origins),
//   - bit by bit where all its bits are kept;
//   - narrow_widths: in those of the bits kept that outputs depend on (passes::demanded_bits);
//   - merge_registers: with registers found to be equal taken as one, which is an invariant of the graph before;
//   - pack_memories: words side by side;
//   - forward_memories: the writes kept in registers are the latest writes to the memory, and the memory's words are
//     those they wrote; the memory itself may answer anything for a word written by one of them;
//   - foresee_reads: a new register says whether the iteration to come takes a token.
// Registers and memories that are no longer there are not related to anything: nothing may depend on them.
//
// Besides, `facts` are what passes::known_values says about the state before the pass: bits and ranges.

#include <z3++.h>

#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "passes/known_values.hpp"
#include "prove/confirm.hpp"
#include "prove/iteration.hpp"

namespace epiline::prove {

/// Something that must not be possible.
struct obligation {
  std::string what;  // that differs: "output 'y': the token"
  dataflow::source_location where;
  z3::expr differs;  // a truth value
};

/// A fact about a term, and whether it restricts it at all.
struct fact {
  z3::expr subject, holds;
};

class relation {
 public:
  /// The graphs must outlive the object.
  relation(z3::context& solver, const std::string& pass, const dataflow::graph& before, const dataflow::graph& after,
           bool exact_tables);

  /// Why this pass's change of the state is not covered; empty if it is.
  [[nodiscard]] const std::string& not_covered() const { return not_covered_; }
  /// What does not fit whatever the values are: an initial value, a table's word; empty if all fits.
  [[nodiscard]] const std::string& misfit() const { return misfit_; }
  /// One sentence for people.
  [[nodiscard]] const std::string& text() const { return text_; }

  [[nodiscard]] const start_state& before() const { return before_start_; }
  [[nodiscard]] const start_state& after() const { return after_start_; }

  /// What the iterations leave behind must be related again.
  [[nodiscard]] std::vector<obligation> at_the_end(const iteration& before, const iteration& after);
  /// What the relation assumes about the state before alone (equal registers, kept writes): it holds again.
  [[nodiscard]] std::vector<obligation> assumptions_at_the_end(const iteration& before);
  [[nodiscard]] const std::vector<z3::expr>& assumptions() const { return assumptions_; }

  /// What is known about the values an iteration starts from, so far as iterations have asked for them.
  [[nodiscard]] const std::vector<fact>& facts() const { return facts_; }
  /// The facts hold again after an iteration of the graph before.
  [[nodiscard]] std::vector<obligation> facts_at_the_end(const iteration& before) const;

  /// Whether tables were replaced by any tables whose words keep the facts: what differs may not differ really.
  [[nodiscard]] bool has_abstract_tables() const { return has_abstract_tables_; }

  /// The words of memories before the pass that iterations have looked at.
  struct word {
    dataflow::memory_id memory;
    z3::expr index, value;
  };
  [[nodiscard]] const std::vector<word>& words() const { return words_; }

  /// Whether iterations that were run from related states did the same, and left related states behind.
  [[nodiscard]] bool holds(const concrete_end& before, const concrete_end& after) const;

 private:
  struct kept_writes {  // of a memory after the pass: registers of the graph after, youngest write first
    dataflow::memory_id memory;
    std::vector<dataflow::register_id> enables, addresses, data;
  };

  struct foreseen_read {
    dataflow::register_id state;  // of the graph after: whether the iteration takes a token
    dataflow::port_id port;       // from here
    dataflow::node_id predicate;  // of the graph before
  };

  /// Whether reads may miss the latest writes to a memory. Where the source promises its distance, they do not look.
  static bool lags(const dataflow::memory& m);
  void choose_masks();
  void start_before();
  void start_after();
  void find_foreseen_reads(std::vector<dataflow::register_id>& made);
  void start_foreseen_reads();
  void find_kept_writes(const std::vector<dataflow::register_id>& made);
  void start_kept_writes();
  /// A term of the registers at the start, where they have other values.
  z3::expr where_registers_are(const z3::expr& term, const std::vector<z3::expr>& values) const;
  std::vector<obligation> foreseen_at_the_end(const iteration& before, const iteration& after);
  void check_initial();
  void add_fact(const z3::expr& subject, const passes::value_set& set);
  z3::expr word_before(dataflow::memory_id m, const z3::expr& index, bool stale);
  z3::expr word_of_parts(dataflow::memory_id after, const z3::expr& index, bool stale);
  z3::expr table_before(std::uint32_t t, const z3::expr& index);
  z3::expr chosen_word(const dataflow::table& t, const z3::expr& index) const;
  z3::expr masked(const z3::expr& term, const llvm::APInt& mask) const;
  z3::expr with_other_bits(const z3::expr& term, const llvm::APInt& mask, const z3::expr& others) const;
  std::vector<word_write> writes_kept_in(const kept_writes& kept, const std::vector<z3::expr>& registers) const;

  z3::context& solver_;
  std::string pass_;
  const dataflow::graph &b_, &a_;
  bool exact_tables_;
  passes::known_values known_;
  std::string not_covered_, misfit_, text_;
  std::vector<llvm::APInt> register_masks_, word_masks_;  // by object after the pass, of its width
  std::vector<dataflow::register_id> equal_to_;           // by register before
  std::vector<foreseen_read> foreseen_;
  std::vector<kept_writes> kept_;
  std::vector<std::vector<word_write>> kept_start_;  // of each of kept_
  start_state before_start_, after_start_;
  std::vector<z3::expr> assumptions_;
  std::vector<fact> facts_;
  std::vector<word> words_;
  bool has_abstract_tables_ = false;
};

}  // namespace epiline::prove
