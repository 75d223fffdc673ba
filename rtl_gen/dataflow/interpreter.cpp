#include "dataflow/interpreter.hpp"

#include <fmt/format.h>
#include <llvm/ADT/ArrayRef.h>

#include <algorithm>
#include <stdexcept>

namespace epiline::dataflow {

namespace {

constexpr std::uint64_t max_memory_bits = std::uint64_t{1} << 32;

std::string place_of(const graph& g, const source_location& where) {
  return where.line == 0 ? std::string() : fmt::format(" ({}:{})", g.files[where.file], where.line);
}

}  // namespace

void interpreter::queue::drop_oldest() {
  head += words_a_token;
  // Moving what is left only once at least as much is free keeps the cost of a token constant.
  if (head < words.size() && (head < 4096 || head * 2 < words.size())) return;
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(head));
  head = 0;
}

interpreter::interpreter(const graph& g) {
  if (const std::string what = find_violation(g); !what.empty()) throw std::invalid_argument(what);
  std::uint64_t bits = 0;
  for (const memory& m : g.memories) {
    bits += std::uint64_t{m.words} * m.width;
    if (bits > max_memory_bits)
      throw std::invalid_argument(fmt::format("memory '{}' is too large to interpret", m.name));
    memory_state s{m.name,     place_of(g, m.where), m.words, m.width, words_for(m.width),
                   m.distance, m.distance_promised,  {},      {}};
    s.contents.resize(std::size_t{m.words} * s.words_a_word, 0);
    for (std::size_t i = 0; i < m.initial.size(); ++i)
      std::copy_n(m.initial[i].getRawData(), s.words_a_word, &s.contents[i * s.words_a_word]);
    if (m.distance > 1) s.written.resize(m.words, 0);
    memories_.push_back(std::move(s));
  }
  for (const table& t : g.tables) {
    table_state s{t.width, {}, t.values.size()};
    for (const llvm::APInt& value : t.values)
      s.words.insert(s.words.end(), value.getRawData(), value.getRawData() + words_for(t.width));
    tables_.push_back(std::move(s));
  }
  for (const port& p : g.ports) {
    ports_.push_back({p.name, place_of(g, p.where), p.width, p.input});
    queues_.push_back({{}, 0, words_for(p.width)});
  }
  program_ = translate(g);
  for (register_id id = 0; id < g.registers.size(); ++id) {
    const register_state& r = g.registers[id];
    registers_.push_back({r.name, place_of(g, r.where), program_.registers[id], r.initial});
  }
  std::size_t words = 0;
  for (const location& value : program_.registers) words += words_for(value.width);
  staged_.resize(words);
  reset();
}

void interpreter::reset() {
  for (const register_info& r : registers_) store(r.value, r.initial.value_or(llvm::APInt(r.value.width, 0)));
  for (queue& q : queues_) {
    q.words.clear();
    q.head = 0;
  }
  for (memory_state& m : memories_) std::fill(m.written.begin(), m.written.end(), 0);
  iterations_ = 0;
  blocked_on_ = none;
  broken_.clear();
}

outcome interpreter::step() {
  if (!broken_.empty()) return outcome::broken_promise;
  blocked_on_ = none;
  for (const batch& b : program_.batches) {
    if (execute(b)) continue;
    roll_back();
    return broken_.empty() ? outcome::blocked : outcome::broken_promise;
  }
  if (!program_.patient_registers.empty() && !check_patience()) {
    roll_back();
    return outcome::broken_promise;
  }
  commit();
  return outcome::advanced;
}

interpreter::progress interpreter::run_until_blocked(std::uint64_t max_iterations) {
  progress p;
  while (p.iterations < max_iterations) {
    p.last = step();
    if (p.last != outcome::advanced) return p;
    ++p.iterations;
  }
  return p;
}

bool interpreter::check_patience() {
  if (program_.patient != none && program_.values[program_.patient] != 0) return true;
  for (const auto& [id, enable] : program_.patient_registers) {
    if (program_.values[enable] == 0) continue;
    const register_info& r = registers_[id];
    broken_ = fmt::format("iteration {}: patient register '{}'{} is updated in an iteration that is not marked patient",
                          iterations_, r.name, r.place);
    return false;
  }
  return true;
}

void interpreter::roll_back() {
  for (auto e = undo_.rbegin(); e != undo_.rend(); ++e) {
    memory_state& m = memories_[e->memory];
    std::copy_n(&undo_words_[e->saved], m.words_a_word, &m.contents[e->address * m.words_a_word]);
    if (!m.written.empty()) m.written[e->address] = e->stamp;
  }
  undo_.clear();
  undo_words_.clear();
}

void interpreter::commit() {
  undo_.clear();
  undo_words_.clear();
  for (const memory_access& access : program_.late_writes) execute_memory_write(access, false);
  for (const port_access& access : program_.reads) {
    if (program_.values[access.predicate] == 0) continue;
    queue& q = queues_[access.port];
    q.drop_oldest();
  }
  for (const port_access& access : program_.writes) {
    if (program_.values[access.predicate] == 0) continue;
    queue& q = queues_[access.port];
    const auto token = program_.values.begin() + access.token.offset;
    q.words.insert(q.words.end(), token, token + q.words_a_token);
  }
  // All at once: a register's next value may be another register's old one.
  word* const v = program_.values.data();
  word* staged = staged_.data();
  for (const register_update& r : program_.narrow_updates) *staged++ = v[v[r.enable] != 0 ? r.next : r.value];
  for (const register_update& r : program_.wide_updates)
    staged = std::copy_n(v + (v[r.enable] != 0 ? r.next : r.value), r.words, staged);
  const word* from = staged_.data();
  for (const register_update& r : program_.narrow_updates) v[r.value] = *from++;
  for (const register_update& r : program_.wide_updates) {
    std::copy_n(from, r.words, v + r.value);
    from += r.words;
  }
  ++iterations_;
}

llvm::APInt interpreter::load(location where) const {
  return {where.width, llvm::ArrayRef<word>(&program_.values[where.offset], words_for(where.width))};
}

void interpreter::store(location where, const llvm::APInt& value) {
  std::copy_n(value.getRawData(), words_for(where.width), &program_.values[where.offset]);
}

const interpreter::port_state& interpreter::checked_port(port_id port, bool input) const {
  if (port >= ports_.size() || ports_[port].input != input)
    throw std::invalid_argument(fmt::format("port {} is no {} port", port, input ? "input" : "output"));
  return ports_[port];
}

void interpreter::push(port_id port, const llvm::APInt& token) {
  const port_state& p = checked_port(port, true);
  if (token.getBitWidth() != p.width)
    throw std::invalid_argument(
        fmt::format("a token of {} bits for port '{}' of {}", token.getBitWidth(), p.name, p.width));
  queue& q = queues_[port];
  q.words.insert(q.words.end(), token.getRawData(), token.getRawData() + q.words_a_token);
}

void interpreter::push(port_id port, std::uint64_t token) {
  const port_state& p = checked_port(port, true);
  if (p.width < word_bits && token >> p.width != 0)
    throw std::invalid_argument(fmt::format("token {:#x} does not fit port '{}' of {} bits", token, p.name, p.width));
  queue& q = queues_[port];
  q.words.push_back(token);
  q.words.resize(q.words.size() + q.words_a_token - 1, 0);
}

std::optional<llvm::APInt> interpreter::pop(port_id port) {
  const port_state& p = checked_port(port, false);
  queue& q = queues_[port];
  if (q.head == q.words.size()) return std::nullopt;
  llvm::APInt token(p.width, llvm::ArrayRef<word>(&q.words[q.head], q.words_a_token));
  q.drop_oldest();
  return token;
}

std::optional<std::uint64_t> interpreter::pop_word(port_id port) {
  const port_state& p = checked_port(port, false);
  if (p.width > word_bits)
    throw std::invalid_argument(fmt::format("a token of port '{}' has {} bits, more than one word", p.name, p.width));
  queue& q = queues_[port];
  if (q.head == q.words.size()) return std::nullopt;
  const std::uint64_t token = q.words[q.head];
  q.drop_oldest();
  return token;
}

std::size_t interpreter::available(port_id port) const {
  if (port >= queues_.size()) throw std::invalid_argument(fmt::format("there is no port {}", port));
  const queue& q = queues_[port];
  return (q.words.size() - q.head) / q.words_a_token;
}

port_id interpreter::find_port(std::string_view name, bool input) const {
  for (port_id id = 0; id < ports_.size(); ++id)
    if (ports_[id].input == input && ports_[id].name == name) return id;
  return none;
}

llvm::APInt interpreter::register_value(register_id id) const { return load(registers_.at(id).value); }

llvm::APInt interpreter::memory_word(memory_id id, std::uint64_t address) const {
  const memory_state& m = memories_.at(id);
  if (address >= m.words) throw std::out_of_range(fmt::format("memory '{}' has no word {}", m.name, address));
  return {m.width, llvm::ArrayRef<word>(&m.contents[address * m.words_a_word], m.words_a_word)};
}

std::string interpreter::message() const {
  if (!broken_.empty()) return broken_;
  if (blocked_on_ == none) return {};
  const port_state& p = ports_[blocked_on_];
  return fmt::format("iteration {} waits for a token of port '{}'{}, which has none left", iterations_, p.name,
                     p.place);
}

}  // namespace epiline::dataflow
