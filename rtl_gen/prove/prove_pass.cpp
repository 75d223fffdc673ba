#include "prove/prove_pass.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <z3++.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "prove/confirm.hpp"
#include "prove/relation.hpp"
#include "prove/terms.hpp"

namespace epiline::prove {

using namespace dataflow;
using llvm::APInt;

namespace {

/// Time this program has had of the processor: on a busy machine a proof gets as far as on an idle one.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Interrupts the solver when the program has had the processor for so long.
class time_limit {
 public:
  time_limit(z3::context& solver, double seconds)
      : watch_([this, &solver, end = processor_seconds() + seconds] {
          std::unique_lock lock(mutex_);
          while (!done_.wait_for(lock, std::chrono::milliseconds(5), [this] { return is_done_; }))
            if (processor_seconds() > end) solver.interrupt();
        }) {}
  ~time_limit() {
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
    watch_.join();
  }
  time_limit(const time_limit&) = delete;
  time_limit& operator=(const time_limit&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread watch_;
};

enum class answer { impossible, possible, unknown };

/// The terms that something is made of.
class cone {
 public:
  void add(const z3::expr& root) {
    std::vector<z3::expr> pending = {root};
    while (!pending.empty()) {
      const z3::expr term = pending.back();
      pending.pop_back();
      const unsigned id = Z3_get_ast_id(term.ctx(), term);
      if (id >= seen_.size()) seen_.resize(id + 1 + id / 2, 0);
      if (seen_[id] != 0) continue;
      seen_[id] = 1;
      if (!term.is_app()) continue;
      for (unsigned i = 0; i < term.num_args(); ++i) pending.push_back(term.arg(i));
    }
  }
  [[nodiscard]] bool contains(const z3::expr& term) const {
    const unsigned id = Z3_get_ast_id(term.ctx(), term);
    return id < seen_.size() && seen_[id] != 0;
  }

 private:
  std::vector<char> seen_;  // by the solver's number of a term
};

class prover {
 public:
  prover(const std::string& pass, const graph& before, const graph& after, const options& given, bool exact_tables)
      : given_(given), b_(before), a_(after), relation_(solver_, pass, before, after, exact_tables) {
    proof_.pass = pass;
  }

  proof run() {
    proof_.relation = relation_.text();
    if (!relation_.not_covered().empty()) {
      proof_.result = verdict::not_covered;
      proof_.reason = relation_.not_covered();
    } else if (!relation_.misfit().empty()) {
      refute_at_start();
    } else {
      compare();
    }
    proof_.seconds = elapsed();
    return std::move(proof_);
  }

  /// A difference that may come from the tables' words alone.
  [[nodiscard]] bool may_be_spurious(const proof& found) const {
    return found.result == verdict::refuted && relation_.has_abstract_tables();
  }

 private:
  [[nodiscard]] double elapsed() const { return processor_seconds() - begin_; }
  [[nodiscard]] double left() const { return given_.seconds - elapsed(); }

  void refute_at_start() {
    proof_.result = verdict::refuted;
    proof_.difference = counterexample{relation_.misfit(), {}, {}, true};  // read off the graphs, nothing to run
  }

  void compare() {
    before_.emplace(solver_, b_, relation_.before());
    after_.emplace(solver_, a_, relation_.after());
    std::vector<obligation> open = ports();
    for (obligation& o : relation_.at_the_end(*before_, *after_)) open.push_back(std::move(o));
    for (obligation& o : relation_.assumptions_at_the_end(*before_)) open.push_back(std::move(o));
    proof_.obligations = static_cast<unsigned>(open.size());
    if (open.empty() || discharge(open, false) || proof_.result == verdict::refuted) return;
    proof_.with_facts = true;
    if (!discharge(open, true)) return;
    std::vector<obligation> facts = relation_.facts_at_the_end(*before_);
    proof_.obligations += static_cast<unsigned>(facts.size());
    discharge(facts, true);
  }

  std::vector<obligation> ports() {
    std::vector<obligation> result;
    if (a_.ports.size() != b_.ports.size()) throw std::logic_error("prove: a pass changed the ports");
    for (port_id p = 0; p < b_.ports.size(); ++p) {
      const port& now = b_.ports[p];
      const z3::expr then = before_->accesses(p), later = after_->accesses(p);
      const source_location where = place_of_access(p);
      const char* direction = now.input ? "input" : "output";
      if (!z3::eq(then, later))
        result.push_back(
            {fmt::format("{} '{}': whether a token is {}", direction, now.name, now.input ? "taken" : "given"), where,
             then != later});
      if (now.input || z3::eq(before_->token(p), after_->token(p))) continue;
      result.push_back(
          {fmt::format("output '{}': the token", now.name), where, then && before_->token(p) != after_->token(p)});
    }
    return result;
  }

  [[nodiscard]] source_location place_of_access(port_id p) const {
    for (const node& n : b_.nodes)
      if ((n.kind == operation::read || n.kind == operation::write) && n.object == p && n.where.line != 0)
        return n.where;
    return b_.ports[p].where;
  }

  /// Proves all of them impossible; what is proved is taken out. False: refuted, or some are open, which the verdict
  /// says with facts, the last resort.
  bool discharge(std::vector<obligation>& open, bool with_facts) {
    const answer all = ask(open, with_facts, left() / (with_facts ? 2 : 3));
    if (all == answer::impossible) {
      open.clear();
      return true;
    }
    if (all == answer::possible) {
      if (with_facts) refute(open);
      return false;
    }
    // One at a time: those that the solver is quick with do not wait for the others.
    for (const unsigned share : {8u, 1u}) {
      for (std::size_t i = 0; i < open.size();) {
        const double limit = std::max(left() / static_cast<double>(share * (open.size() - i)), 0.02);
        const std::vector<obligation> one = {open[i]};
        const answer found = left() > 0 ? ask(one, with_facts, limit) : answer::unknown;
        if (found == answer::possible && with_facts) {
          refute(one);
          return false;
        }
        if (found == answer::impossible)
          open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
        else
          ++i;
      }
      if (!with_facts) break;  // they may help
    }
    if (open.empty()) return true;
    if (!with_facts) return false;
    proof_.result = verdict::timed_out;
    proof_.unproved += static_cast<unsigned>(open.size());
    return false;
  }

  answer ask(const std::vector<obligation>& questions, bool with_facts, double seconds) {
    if (seconds <= 0) return answer::unknown;
    z3::expr_vector differences(solver_);
    for (const obligation& o : questions) differences.push_back(o.differs);
    const z3::expr difference = z3::mk_or(differences);
    // Its own bit-vector tactics: the general solver is many times slower on such terms.
    z3::tactic t = z3::tactic(solver_, "simplify") & z3::tactic(solver_, "propagate-values") &
                   z3::tactic(solver_, "solve-eqs") & z3::tactic(solver_, "elim-uncnstr") &
                   z3::tactic(solver_, "simplify") & z3::tactic(solver_, "ackermannize_bv") &
                   z3::tactic(solver_, "simplify") & z3::tactic(solver_, "max-bv-sharing") &
                   z3::tactic(solver_, "bit-blast") & z3::tactic(solver_, "sat");
    z3::solver engine = t.mk_solver();
    engine.add(difference);
    cone relevant;
    relevant.add(difference);
    for (const z3::expr& assumption : relation_.assumptions()) {
      engine.add(assumption);
      relevant.add(assumption);
    }
    if (with_facts)
      for (const fact& f : relation_.facts())
        if (relevant.contains(f.subject)) engine.add(f.holds);
    const time_limit limit(solver_, seconds);
    try {
      switch (engine.check()) {
        case z3::unsat:
          return answer::impossible;
        case z3::sat:
          model_.emplace(engine.get_model());
          return answer::possible;
        default:
          return answer::unknown;
      }
    } catch (const z3::exception&) {  // ran out of time or memory at a place that cannot say so otherwise
      return answer::unknown;
    }
  }

  void refute(const std::vector<obligation>& questions) {
    proof_.result = verdict::refuted;
    const auto found = std::find_if(questions.begin(), questions.end(),
                                    [&](const obligation& o) { return model_->eval(o.differs, true).is_true(); });
    const obligation& differing = found == questions.end() ? questions.front() : *found;
    counterexample example;
    example.what = differing.what;
    if (differing.where.line != 0)
      example.place = fmt::format("{}:{}", b_.files[differing.where.file], differing.where.line);
    describe_start(differing, example);
    example.confirmed = confirm();
    proof_.difference = std::move(example);
  }

  static std::string in_hexadecimal(const APInt& value) { return "0x" + llvm::toString(value, 16, false); }

  void describe_start(const obligation& differing, counterexample& example) const {
    cone relevant;
    relevant.add(differing.differs);
    const auto note = [&](std::string name, const z3::expr& term) {
      if (relevant.contains(term)) example.start.emplace_back(std::move(name), in_hexadecimal(value_of(*model_, term)));
    };
    for (register_id r = 0; r < b_.registers.size(); ++r)
      note("register " + b_.registers[r].name, relation_.before().registers[r]);
    for (const relation::word& w : relation_.words())
      if (w.memory != none)
        note(fmt::format("memory {}[{}]", b_.memories[w.memory].name, in_hexadecimal(value_of(*model_, w.index))),
             w.value);
    for (port_id p = 0; p < b_.ports.size(); ++p)
      if (b_.ports[p].input) note("token " + b_.ports[p].name, relation_.before().tokens[p]);
  }

  /// Starts both graphs in the interpreter where the model says.
  bool confirm() {
    concrete_start then, now;
    const std::vector<relation::word> words = relation_.words();  // asking for more makes more
    for (const z3::expr& value : relation_.before().registers) then.registers.push_back(value_of(*model_, value));
    for (const z3::expr& value : relation_.after().registers) now.registers.push_back(value_of(*model_, value));
    for (const z3::expr& value : relation_.before().tokens) then.tokens.push_back(value_of(*model_, value));
    now.tokens = then.tokens;
    then.words.resize(b_.memories.size());
    now.words.resize(a_.memories.size());
    const auto look = [&](const start_state& start, memory_id m, const APInt& index, concrete_start& into) {
      into.words[m].emplace(index.getZExtValue(), value_of(*model_, start.word(m, constant_term(solver_, index))));
    };
    for (const relation::word& w : words) {
      if (w.memory == none) continue;
      const APInt index = value_of(*model_, w.index);
      look(relation_.before(), w.memory, index, then);
      for (memory_id m = 0; m < a_.memories.size(); ++m)
        if (std::count(a_.memories[m].origins.begin(), a_.memories[m].origins.end(), w.memory) != 0)
          look(relation_.after(), m, index, now);
    }
    return !relation_.holds(run_one_iteration(b_, then), run_one_iteration(a_, now));
  }

  double begin_ = processor_seconds();
  options given_;
  const graph &b_, &a_;
  z3::context solver_;
  relation relation_;
  std::optional<iteration> before_, after_;
  std::optional<z3::model> model_;
  proof proof_;
};

}  // namespace

const char* name_of(verdict v) {
  switch (v) {
    case verdict::proved:
      return "proved";
    case verdict::timed_out:
      return "timed out";
    case verdict::refuted:
      return "refuted";
    case verdict::not_covered:
      return "not covered";
  }
  return "unknown";
}

proof prove_pass(const std::string& pass, const graph& before, const graph& after, const options& given) {
  prover quick(pass, before, after, given, false);
  proof result = quick.run();
  if (!quick.may_be_spurious(result)) return result;
  const double spent = result.seconds;
  result = prover(pass, before, after, {given.seconds - spent}, true).run();
  result.seconds += spent;
  return result;
}

std::string solver_version() {
  unsigned major = 0, minor = 0, build = 0, revision = 0;
  Z3_get_version(&major, &minor, &build, &revision);
  return fmt::format("{}.{}.{}", major, minor, build);
}

}  // namespace epiline::prove
