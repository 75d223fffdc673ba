// The parts of a relation that are about numbers, not terms: what the machines start with, and what the interpreter's
// iterations end with.
#include <fmt/format.h>

#include "prove/relation.hpp"

namespace epiline::prove {

using namespace dataflow;
using llvm::APInt;

namespace {

bool contains(const passes::value_set& set, const APInt& value) {
  return !(set.bits.Zero.intersects(value)) && set.bits.One.isSubsetOf(value) && set.range.contains(value);
}

APInt initial_word(const memory& m, std::size_t i) { return m.initial.empty() ? APInt(m.width, 0) : m.initial[i]; }

}  // namespace

bool relation::lags(const memory& m) { return m.distance > 1 && !m.distance_promised; }

/// What the machines start with is related; the facts hold of it.
void relation::check_initial() {
  const auto value_at_start = [](const register_state& r) { return r.initial.value_or(APInt(r.width, 0)); };
  for (register_id r = 0; r < b_.registers.size(); ++r) {
    const register_state &own = b_.registers[r], &equal = b_.registers[equal_to_[r]];
    if (!contains(known_.of_register(r), value_at_start(own)))
      misfit_ = fmt::format("register '{}' starts outside of what is known about it", own.name);
    if (value_at_start(own) != value_at_start(equal) || own.resets != equal.resets)
      misfit_ = fmt::format("registers '{}' and '{}' do not start equal", own.name, equal.name);
  }
  bool patient = false;
  for (register_id r = 0; r < a_.registers.size(); ++r) {
    const register_state& now = a_.registers[r];
    patient |= now.patient;
    if (now.origin == none) continue;
    const register_state& then = b_.registers[now.origin];
    const APInt difference = value_at_start(then).trunc(now.width) ^ value_at_start(now);
    if (difference.intersects(register_masks_[r]) || now.initial.has_value() != then.initial.has_value() ||
        now.resets != then.resets)
      misfit_ = fmt::format("register '{}' starts with another value", now.name);
    if (now.patient != then.patient) misfit_ = fmt::format("register '{}' is patient in one graph only", now.name);
  }
  if (patient && b_.patient == none) misfit_ = "no iteration was patient";
  for (memory_id m = 0; m < a_.memories.size(); ++m) {
    const memory& now = a_.memories[m];
    unsigned low = 0;
    for (const memory_id origin : now.origins) {
      const memory& then = b_.memories[origin];
      const unsigned width = std::min(then.width, now.width - low);
      if (now.words != then.words || now.initial.empty() != then.initial.empty())
        misfit_ = fmt::format("memory '{}' has other words", now.name);
      if (now.distance != then.distance && !(lags(now) && then.distance == 1))
        misfit_ = fmt::format("memory '{}' has another distance", now.name);
      if (now.distance_promised != then.distance_promised)
        misfit_ = fmt::format("memory '{}': only one distance is promised", now.name);
      for (unsigned i = 0; misfit_.empty() && i < now.initial.size(); ++i) {
        const APInt difference = initial_word(then, i).trunc(width) ^ initial_word(now, i).extractBits(width, low);
        if (difference.intersects(word_masks_[m].extractBits(width, low)))
          misfit_ = fmt::format("word {} of memory '{}' starts with another value", i, now.name);
      }
      low += width;
    }
  }
  for (memory_id m = 0; m < b_.memories.size(); ++m)
    for (unsigned i = 0; i < b_.memories[m].words && (i == 0 || !b_.memories[m].initial.empty()); ++i)
      if (!contains(known_.of_memory(m), initial_word(b_.memories[m], i)))
        misfit_ = fmt::format("memory '{}' starts outside of what is known about it", b_.memories[m].name);
  for (std::uint32_t t = 0; t < b_.tables.size(); ++t)
    for (const APInt& value : b_.tables[t].values)
      if (!contains(known_.of_table(t), value))
        misfit_ = fmt::format("table '{}' has words outside of what is known about it", b_.tables[t].name);
  for (const table& now : a_.tables) {
    if (now.origin == none) continue;
    const table& then = b_.tables[now.origin];
    bool equal = now.values.size() == then.values.size() && now.width <= then.width;
    for (std::size_t i = 0; equal && i < now.values.size(); ++i)
      equal = now.values[i] == then.values[i].trunc(now.width);
    if (!equal) misfit_ = fmt::format("table '{}' has other words", now.name);
  }
  for (const foreseen_read& f : foreseen_)
    if (!a_.registers[f.state].initial || !a_.registers[f.state].resets)
      misfit_ = fmt::format("register '{}' keeps what it foresaw when a reset comes", a_.registers[f.state].name);
  for (const kept_writes& kept : kept_)
    for (const register_id r : kept.enables)
      if (!a_.registers[r].initial || !a_.registers[r].initial->isZero() || !a_.registers[r].resets)
        misfit_ = fmt::format("register '{}' starts with a write that never was", a_.registers[r].name);
}

bool relation::holds(const concrete_end& before, const concrete_end& after) const {
  if (before.advanced != after.advanced || before.accessed != after.accessed || before.tokens != after.tokens)
    return false;
  for (register_id r = 0; r < a_.registers.size(); ++r) {
    const register_id origin = a_.registers[r].origin;
    if (origin == none) continue;
    const APInt difference = before.registers[origin].trunc(a_.registers[r].width) ^ after.registers[r];
    if (difference.intersects(register_masks_[r])) return false;
  }
  if (!foreseen_.empty()) {
    concrete_start next{before.registers, {}, {}};
    next.words.resize(b_.memories.size());
    for (const port& p : b_.ports) next.tokens.emplace_back(p.width, 0);
    const concrete_end then = run_one_iteration(b_, next);
    for (const foreseen_read& f : foreseen_)
      if (then.accessed[f.port] != after.registers[f.state].isOne()) return false;
  }
  for (register_id r = 0; r < b_.registers.size(); ++r)
    if (before.registers[r] != before.registers[equal_to_[r]] || !contains(known_.of_register(r), before.registers[r]))
      return false;
  for (memory_id m = 0; m < a_.memories.size(); ++m) {
    unsigned low = 0;
    for (const memory_id origin : a_.memories[m].origins) {
      const unsigned width = std::min(b_.memories[origin].width, a_.memories[m].width - low);
      for (const auto& [index, word] : before.words[origin]) {
        const auto now = after.words[m].find(index);
        if (now == after.words[m].end()) continue;
        const APInt difference = word.trunc(width) ^ now->second.extractBits(width, low);
        if (difference.intersects(word_masks_[m].extractBits(width, low))) return false;
      }
      low += width;
    }
  }
  for (memory_id m = 0; m < b_.memories.size(); ++m)
    for (const auto& [index, word] : before.words[m])
      if (!contains(known_.of_memory(m), word)) return false;
  return true;
}

}  // namespace epiline::prove
