#include "prove/relation.hpp"

#include <fmt/format.h>

#include "passes/demanded_bits.hpp"
#include "passes/merge_registers.hpp"
#include "prove/terms.hpp"

namespace epiline::prove {

using namespace dataflow;
using llvm::APInt;

namespace {

/// A table of up to this many words is always taken word by word.
constexpr std::size_t small_table = 256;

/// The parts of a name from the source, a pass and a number, for constants of the solver.
std::string term_name(const char* what, const std::string& name, std::size_t id) {
  return fmt::format("{} {} {}", what, id, name);
}

}  // namespace

relation::relation(z3::context& solver, const std::string& pass, const graph& before, const graph& after,
                   bool exact_tables)
    : solver_(solver), pass_(pass), b_(before), a_(after), exact_tables_(exact_tables), known_(before) {
  if (pass_ == "narrow_widths")
    text_ = "the kept bits of the state that outputs depend on are equal";
  else if (pass_ == "merge_registers")
    text_ = "state is equal, and so are merged registers among themselves";
  else
    text_ = "all state that is left is equal";
  for (register_id r = 0; r < b_.registers.size(); ++r) equal_to_.push_back(r);
  if (pass_ == "merge_registers") equal_to_ = passes::first_equal_registers(b_);
  std::vector<register_id> made;
  for (register_id r = 0; r < a_.registers.size(); ++r)
    if (a_.registers[r].origin == none) made.push_back(r);
  find_foreseen_reads(made);
  if (!foreseen_.empty()) text_ += "; new registers say whether a token is read";
  find_kept_writes(made);
  if (!kept_.empty()) text_ += "; registers hold the latest writes to memories";
  if (!not_covered_.empty()) return;
  choose_masks();
  if (misfit_.empty()) check_initial();
  if (!misfit_.empty()) return;
  start_before();
  start_after();
}

/// The registers a pass made of predicates of reads, where those hang on registers alone; they are taken out of `made`.
void relation::find_foreseen_reads(std::vector<register_id>& made) {
  const auto read_of = [](const graph& g, port_id port) -> node_id {
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (g.nodes[id].kind == operation::read && g.nodes[id].object == port) return id;
    return none;
  };
  const auto hangs_on_registers = [this](node_id predicate) {
    std::vector<node_id> pending = {predicate};
    while (!pending.empty()) {
      const node& n = b_.nodes[pending.back()];
      pending.pop_back();
      if (n.kind == operation::read || n.kind == operation::memory_read) return false;
      pending.insert(pending.end(), n.operands.begin(), n.operands.end());
    }
    return true;
  };
  for (port_id p = 0; p < a_.ports.size(); ++p) {
    const node_id then = read_of(b_, p), now = read_of(a_, p);
    if (then == none || now == none) continue;
    const node& predicate = a_.nodes[a_.nodes[now].operands[0]];
    if (predicate.kind != operation::register_value || a_.registers[predicate.object].origin != none) continue;
    if (!hangs_on_registers(b_.nodes[then].operands[0])) continue;
    foreseen_.push_back({predicate.object, p, b_.nodes[then].operands[0]});
    std::erase(made, predicate.object);
  }
}

/// The registers a pass made for memories that may lag from now on: for each write, its enable, address and data.
void relation::find_kept_writes(const std::vector<register_id>& made) {
  std::size_t next = 0;
  for (memory_id m = 0; m < a_.memories.size(); ++m) {
    const memory& now = a_.memories[m];
    if (now.origins.empty()) {
      not_covered_ = fmt::format("memory '{}' is new", now.name);
      return;
    }
    const memory& then = b_.memories[now.origins[0]];
    if (!lags(now) || then.distance != 1 || now.origins.size() > 1) continue;
    kept_writes kept{m, {}, {}, {}};
    for (unsigned i = 1; i < now.distance && next + 3 <= made.size(); ++i, next += 3) {
      kept.enables.push_back(made[next]);
      kept.addresses.push_back(made[next + 1]);
      kept.data.push_back(made[next + 2]);
      if (a_.registers[made[next]].width != 1 || a_.registers[made[next + 2]].width != now.width)
        not_covered_ = fmt::format("the registers made for memory '{}' are no writes", now.name);
    }
    if (kept.enables.size() + 1 != now.distance)
      not_covered_ = fmt::format("the writes in flight to memory '{}' are not in registers", now.name);
    kept_.push_back(std::move(kept));
  }
  if (next != made.size() && not_covered_.empty())
    not_covered_ = fmt::format("register '{}' is new", a_.registers[made[next]].name);
}

void relation::choose_masks() {
  const bool by_demand = pass_ == "narrow_widths";
  const passes::demanded_bits demanded(b_, &known_);
  for (const register_state& r : a_.registers) {
    APInt mask = APInt::getAllOnes(r.width);
    if (r.origin != none) {
      if (r.width > b_.registers[r.origin].width) misfit_ = fmt::format("register '{}' became wider", r.name);
      if (!misfit_.empty()) return;
      if (by_demand) mask = demanded.of_register(r.origin).trunc(r.width);
    }
    register_masks_.push_back(std::move(mask));
  }
  for (const memory& m : a_.memories) {
    APInt mask = APInt::getAllOnes(m.width);
    unsigned width = 0;
    for (const memory_id origin : m.origins) width += b_.memories[origin].width;
    if (m.width > width || (m.origins.size() > 1 && m.width != width))
      misfit_ = fmt::format("memory '{}' has {} bits instead of {}", m.name, m.width, width);
    if (!misfit_.empty()) return;
    if (by_demand && m.origins.size() == 1) mask = demanded.of_memory(m.origins[0]).trunc(m.width);
    word_masks_.push_back(std::move(mask));
  }
}

void relation::add_fact(const z3::expr& subject, const passes::value_set& set) {
  if (is_restrictive(set)) facts_.push_back({subject, lies_in(subject, set)});
}

z3::expr relation::masked(const z3::expr& term, const APInt& mask) const {
  return mask.isAllOnes() ? term : term & constant_term(solver_, mask);
}

/// The bits of `term` in the mask, and others elsewhere.
z3::expr relation::with_other_bits(const z3::expr& term, const APInt& mask, const z3::expr& others) const {
  if (mask.isAllOnes()) return term;
  return masked(term, mask) | masked(others, ~mask);
}

void relation::start_before() {
  for (register_id r = 0; r < b_.registers.size(); ++r) {
    if (equal_to_[r] != r) {
      before_start_.registers.push_back(before_start_.registers[equal_to_[r]]);
      continue;
    }
    const z3::expr value =
        solver_.bv_const(term_name("register", b_.registers[r].name, r).c_str(), b_.registers[r].width);
    before_start_.registers.push_back(value);
    add_fact(value, known_.of_register(r));
  }
  for (port_id p = 0; p < b_.ports.size(); ++p)
    before_start_.tokens.push_back(
        solver_.bv_const(term_name("token", b_.ports[p].name, p).c_str(), b_.ports[p].width));
  before_start_.recent_writes.resize(b_.memories.size());
  for (memory_id m = 0; m < b_.memories.size(); ++m)
    for (unsigned i = 1; lags(b_.memories[m]) && i < b_.memories[m].distance; ++i) {
      const auto name = [&](const char* what) { return term_name(what, fmt::format("write {}", i), m); };
      before_start_.recent_writes[m].push_back(
          {solver_.bool_const(name("recent").c_str()),
           solver_.bv_const(name("recent index").c_str(), index_width(b_.memories[m].words)),
           solver_.bv_const(name("recent data").c_str(), b_.memories[m].width)});
    }
  before_start_.word = [this](memory_id m, const z3::expr& index) { return word_before(m, index, false); };
  before_start_.stale_word = [this](memory_id m, const z3::expr& index) { return word_before(m, index, true); };
  before_start_.table_word = [this](std::uint32_t t, const z3::expr& index) { return table_before(t, index); };
}

void relation::start_after() {
  for (register_id r = 0; r < a_.registers.size(); ++r) {
    const register_state& now = a_.registers[r];
    const z3::expr own = solver_.bv_const(term_name("other", now.name, r).c_str(), now.width);
    after_start_.registers.push_back(
        now.origin == none
            ? own
            : with_other_bits(resized(before_start_.registers[now.origin], now.width), register_masks_[r], own));
  }
  start_foreseen_reads();
  after_start_.tokens = before_start_.tokens;
  for (const memory& m : a_.memories) after_start_.recent_writes.push_back(before_start_.recent_writes[m.origins[0]]);
  start_kept_writes();
  after_start_.word = [this](memory_id m, const z3::expr& index) { return word_of_parts(m, index, false); };
  after_start_.stale_word = [this](memory_id m, const z3::expr& index) { return word_of_parts(m, index, true); };
  after_start_.table_word = [this](std::uint32_t t, const z3::expr& index) {
    const table& now = a_.tables[t];
    return now.origin == none ? chosen_word(now, index) : resized(table_before(now.origin, index), now.width);
  };
}

void relation::start_foreseen_reads() {
  if (foreseen_.empty()) return;
  const iteration now(solver_, b_, before_start_);
  for (const foreseen_read& f : foreseen_) after_start_.registers[f.state] = now.node(f.predicate);
}

z3::expr relation::where_registers_are(const z3::expr& term, const std::vector<z3::expr>& values) const {
  z3::expr_vector from(solver_), to(solver_);
  for (register_id r = 0; r < b_.registers.size(); ++r) {
    from.push_back(before_start_.registers[r]);
    to.push_back(values[r]);
  }
  return z3::expr(term).substitute(from, to);
}

/// What the registers say is true of the next iteration: of the state left behind, and of the state a reset leaves.
std::vector<obligation> relation::foreseen_at_the_end(const iteration& before, const iteration& after) {
  std::vector<obligation> result;
  std::vector<z3::expr> left, reset;
  for (register_id r = 0; r < b_.registers.size(); ++r) {
    const register_state& then = b_.registers[r];
    left.push_back(before.register_after(r));
    // A register that no reset reaches may hold anything then.
    reset.push_back(then.initial && then.resets ? constant_term(solver_, *then.initial) : before_start_.registers[r]);
  }
  for (const foreseen_read& f : foreseen_) {
    const register_state& now = a_.registers[f.state];
    const std::string subject =
        fmt::format("register '{}': whether a token is read from '{}'", now.name, b_.ports[f.port].name);
    result.push_back({subject + " next", now.where,
                      where_registers_are(before.node(f.predicate), left) != after.register_after(f.state)});
    result.push_back({subject + " after a reset", now.where,
                      where_registers_are(before.node(f.predicate), reset) !=
                          constant_term(solver_, now.initial.value_or(APInt(1, 0)))});
  }
  return result;
}

std::vector<word_write> relation::writes_kept_in(const kept_writes& kept,
                                                 const std::vector<z3::expr>& registers) const {
  std::vector<word_write> writes;
  for (std::size_t i = 0; i < kept.enables.size(); ++i) {
    const word_place at = place_of(registers[kept.addresses[i]], a_.memories[kept.memory].words);
    writes.push_back({is_one(registers[kept.enables[i]]) && at.inside, at.index, registers[kept.data[i]]});
  }
  return writes;
}

namespace {

/// That word `index` of a memory is what the `i`th latest of some writes wrote, unless a later one wrote it, too.
z3::expr keeps_word(const std::vector<word_write>& writes, std::size_t i, const z3::expr& word) {
  z3::expr latest = writes[i].hits;
  for (std::size_t k = 0; k < i; ++k) latest = latest && !(writes[k].hits && writes[k].index == writes[i].index);
  return z3::implies(latest, word == writes[i].data);
}

}  // namespace

void relation::start_kept_writes() {
  for (const kept_writes& kept : kept_) {
    kept_start_.push_back(writes_kept_in(kept, after_start_.registers));
    const std::vector<word_write>& writes = kept_start_.back();
    after_start_.recent_writes[kept.memory] = writes;
    const memory_id then = a_.memories[kept.memory].origins[0];
    for (std::size_t i = 0; i < writes.size(); ++i)
      assumptions_.push_back(keeps_word(writes, i, word_before(then, writes[i].index, false)));
  }
}

z3::expr relation::word_before(memory_id m, const z3::expr& index, bool stale) {
  const memory& then = b_.memories[m];
  const z3::func_decl function = solver_.function(term_name(stale ? "stale" : "memory", then.name, m).c_str(),
                                                  index.get_sort(), solver_.bv_sort(then.width));
  const z3::expr value = function(index);
  for (const word& w : words_)
    if (z3::eq(w.value, value)) return value;
  words_.push_back({stale ? none : m, index, value});
  add_fact(value, known_.of_memory(m));
  return value;
}

/// A word after the pass from those before it lie side by side in.
z3::expr relation::word_of_parts(memory_id after, const z3::expr& index, bool stale) {
  const memory& now = a_.memories[after];
  if (now.origins.size() == 1) {
    const z3::expr part = resized(word_before(now.origins[0], index, stale), now.width);
    const z3::func_decl others =
        solver_.function(term_name(stale ? "other stale" : "other word", now.name, after).c_str(), index.get_sort(),
                         solver_.bv_sort(now.width));
    return with_other_bits(part, word_masks_[after], others(index));
  }
  z3::expr_vector parts(solver_);
  for (auto origin = now.origins.rbegin(); origin != now.origins.rend(); ++origin)
    parts.push_back(word_before(*origin, index, stale));
  return z3::concat(parts);
}

z3::expr relation::table_before(std::uint32_t t, const z3::expr& index) {
  const table& then = b_.tables[t];
  if (exact_tables_ || then.values.size() <= small_table) return chosen_word(then, index);
  has_abstract_tables_ = true;
  const z3::func_decl function =
      solver_.function(term_name("table", then.name, t).c_str(), index.get_sort(), solver_.bv_sort(then.width));
  const z3::expr value = function(index);
  add_fact(value, known_.of_table(t));  // known of the words themselves, which no iteration changes
  return value;
}

/// A tree of choices by the bits of the index.
z3::expr relation::chosen_word(const table& t, const z3::expr& index) const {
  std::vector<z3::expr> words;
  for (const APInt& value : t.values) words.push_back(constant_term(solver_, value));
  const unsigned bits = index.get_sort().bv_size();
  for (unsigned bit = 0; bit < bits && words.size() > 1; ++bit) {
    const z3::expr odd = is_one(bits_of(index, bit, 1));
    std::vector<z3::expr> chosen;
    for (std::size_t i = 0; i < words.size(); i += 2) {
      const bool same = i + 1 >= words.size() || z3::eq(words[i], words[i + 1]);
      chosen.push_back(same ? words[i] : z3::ite(odd, words[i + 1], words[i]));
    }
    words = std::move(chosen);
  }
  return words.front();
}

std::vector<obligation> relation::at_the_end(const iteration& before, const iteration& after) {
  std::vector<obligation> result;
  const auto equal = [&](std::string what, source_location where, const z3::expr& x, const z3::expr& y) {
    if (!z3::eq(x, y)) result.push_back({std::move(what), where, x != y});
  };
  for (register_id r = 0; r < a_.registers.size(); ++r) {
    const register_state& now = a_.registers[r];
    if (now.origin == none || register_masks_[r].isZero()) continue;
    equal(fmt::format("register '{}': its next value", now.name), now.where,
          masked(resized(before.register_after(now.origin), now.width), register_masks_[r]),
          masked(after.register_after(r), register_masks_[r]));
  }
  for (obligation& o : foreseen_at_the_end(before, after)) result.push_back(std::move(o));
  for (memory_id m = 0; m < a_.memories.size(); ++m) {
    const memory& now = a_.memories[m];
    bool written = !after.writes(m).empty();
    for (const memory_id origin : now.origins) written |= !before.writes(origin).empty();
    if (!written) continue;
    const z3::expr index = solver_.bv_const(term_name("any word", now.name, m).c_str(), index_width(now.words));
    z3::expr then = solver_.bool_val(false);
    if (now.origins.size() == 1) {
      then = resized(before.word_after(now.origins[0], index), now.width);
    } else {
      z3::expr_vector parts(solver_);
      for (auto origin = now.origins.rbegin(); origin != now.origins.rend(); ++origin)
        parts.push_back(before.word_after(*origin, index));
      then = z3::concat(parts);
    }
    equal(fmt::format("memory '{}': a word", now.name), now.where, masked(then, word_masks_[m]),
          masked(after.word_after(m, index), word_masks_[m]));
    if (!lags(now)) continue;
    const auto touches = [&](const std::vector<word_write>& writes) {
      z3::expr hit = solver_.bool_val(false);
      for (const word_write& write : writes) hit = hit || (write.hits && write.index == index);
      return hit;
    };
    for (const memory_id origin : now.origins)
      equal(fmt::format("memory '{}': which word is written", now.name), now.where, touches(before.writes(origin)),
            touches(after.writes(m)));
  }
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const memory& now = a_.memories[kept_[k].memory];
    std::vector<z3::expr> registers;
    for (register_id r = 0; r < a_.registers.size(); ++r) registers.push_back(after.register_after(r));
    const std::vector<word_write> kept = writes_kept_in(kept_[k], registers);
    std::vector<word_write> latest = before.writes(now.origins[0]);
    latest.insert(latest.end(), kept_start_[k].begin(), kept_start_[k].end());
    for (std::size_t i = 0; i < kept.size(); ++i)
      result.push_back({fmt::format("memory '{}': the write kept in registers", now.name), now.where,
                        kept[i].hits != latest[i].hits ||
                            (kept[i].hits && (kept[i].index != latest[i].index || kept[i].data != latest[i].data))});
  }
  if (b_.patient != none && a_.patient != none)
    equal("which iterations are patient", b_.nodes[b_.patient].where, before.node(b_.patient), after.node(a_.patient));
  return result;
}

std::vector<obligation> relation::assumptions_at_the_end(const iteration& before) {
  std::vector<obligation> result;
  for (register_id r = 0; r < b_.registers.size(); ++r)
    if (equal_to_[r] != r && !z3::eq(before.register_after(r), before.register_after(equal_to_[r])))
      result.push_back({fmt::format("registers '{}' and '{}', which were taken for equal", b_.registers[r].name,
                                    b_.registers[equal_to_[r]].name),
                        b_.registers[r].where, before.register_after(r) != before.register_after(equal_to_[r])});
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const memory_id then = a_.memories[kept_[k].memory].origins[0];
    std::vector<word_write> latest = before.writes(then);
    latest.insert(latest.end(), kept_start_[k].begin(), kept_start_[k].end() - 1);
    for (std::size_t i = 0; i < latest.size(); ++i)
      result.push_back({fmt::format("memory '{}': a word of a kept write", b_.memories[then].name),
                        b_.memories[then].where, !keeps_word(latest, i, before.word_after(then, latest[i].index))});
  }
  return result;
}

std::vector<obligation> relation::facts_at_the_end(const iteration& before) const {
  std::vector<obligation> result;
  for (register_id r = 0; r < b_.registers.size(); ++r)
    if (is_restrictive(known_.of_register(r)))
      result.push_back({fmt::format("register '{}': that it keeps its range", b_.registers[r].name),
                        b_.registers[r].where, !lies_in(before.register_after(r), known_.of_register(r))});
  for (memory_id m = 0; m < b_.memories.size(); ++m)
    if (is_restrictive(known_.of_memory(m)))
      for (const word_write& write : before.writes(m))
        result.push_back({fmt::format("memory '{}': that its words keep their range", b_.memories[m].name),
                          b_.memories[m].where, write.hits && !lies_in(write.data, known_.of_memory(m))});
  return result;
}

}  // namespace epiline::prove
