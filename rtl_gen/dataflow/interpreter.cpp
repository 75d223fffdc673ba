#include "dataflow/interpreter.hpp"

#include <fmt/format.h>
#include <llvm/ADT/ArrayRef.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "dataflow/evaluate.hpp"

namespace epiline::dataflow {

namespace {

using word = std::uint64_t;
constexpr unsigned word_bits = 64;
constexpr std::uint64_t max_memory_bits = std::uint64_t{1} << 32;

std::uint32_t words_for(unsigned width) { return (width + word_bits - 1) / word_bits; }

std::string place_of(const graph& g, const source_location& where) {
  return where.line == 0 ? std::string() : fmt::format(" ({}:{})", g.files[where.file], where.line);
}

word sign_extended(word value, unsigned shift) {
  return static_cast<word>(static_cast<std::int64_t>(value << shift) >> shift);
}

std::int64_t as_signed(word value) { return static_cast<std::int64_t>(value); }

/// `width` bits of a multi-word value, from bit `low`; width <= 64.
word extract(const word* value, unsigned low, unsigned width) {
  const unsigned index = low / word_bits, shift = low % word_bits;
  word result = value[index] >> shift;
  if (shift != 0 && shift + width > word_bits) result |= value[index + 1] << (word_bits - shift);
  return result & (~word{0} >> (word_bits - width));
}

/// Puts `width` bits at bit `low` of a multi-word value that is zero there; `part` has zeros above its width.
void deposit(word* value, unsigned low, unsigned width, const word* part) {
  for (unsigned done = 0; done < width; done += word_bits, ++part) {
    const unsigned index = (low + done) / word_bits, shift = (low + done) % word_bits;
    value[index] |= *part << shift;
    if (shift != 0 && shift + std::min(word_bits, width - done) > word_bits)
      value[index + 1] |= *part >> (word_bits - shift);
  }
}

}  // namespace

void interpreter::queue::drop_oldest() {
  head += words_a_token;
  // Moving what is left only once at least as much is free keeps the cost of a token constant.
  if (head < words.size() && (head < 4096 || head * 2 < words.size())) return;
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(head));
  head = 0;
}

/// Turns the nodes of a graph into batches of instructions.
struct interpreter::translator {
  translator(interpreter& target, const graph& source) : t(target), g(source) {}

  void run() {
    place_fixed_values();
    find_dependences();
    emit_batches();
    place_effects();
  }

  location allocate(unsigned width) {
    const auto offset = t.values_.size();
    t.values_.resize(offset + words_for(width), 0);
    return {static_cast<std::uint32_t>(offset), width};
  }

  bool narrow(const node& n) const { return n.width <= word_bits; }
  bool operands_narrow(const node& n) const {
    return std::all_of(n.operands.begin(), n.operands.end(), [&](node_id id) { return narrow(g.nodes[id]); });
  }

  /// Constants and registers have a place before any instruction runs.
  void place_fixed_values() {
    where.resize(g.nodes.size(), location{none, 0});
    for (const register_state& r : g.registers)
      t.registers_.push_back({r.name, place_of(g, r.where), allocate(r.width), r.initial});
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const node& n = g.nodes[id];
      if (n.kind == operation::register_value) where[id] = t.registers_[n.object].value;
      if (n.kind != operation::constant) continue;
      where[id] = allocate(n.width);
      t.store(where[id], n.value);
    }
  }

  static bool is_fixed(const node& n) { return n.kind == operation::constant || n.kind == operation::register_value; }

  /// A write into a port, and a memory write no read of the same iteration follows, wait for the iteration's end.
  bool is_late(node_id id) const {
    const node& n = g.nodes[id];
    return n.kind == operation::write ||
           (n.kind == operation::memory_write && (last_read[n.object] == none || last_read[n.object] < id));
  }

  void depends(node_id user, node_id on) {
    if (is_fixed(g.nodes[on])) return;
    users[on].push_back(user);
    ++missing[user];
  }

  void find_dependences() {
    users.resize(g.nodes.size());
    missing.resize(g.nodes.size(), 0);
    last_read.resize(g.memories.size(), none);
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (g.nodes[id].kind == operation::memory_read) last_read[g.nodes[id].object] = id;
    std::vector<node_id> last_write(g.memories.size(), none);
    std::vector<std::vector<node_id>> reads_since(g.memories.size());
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      const node& n = g.nodes[id];
      if (is_late(id)) continue;
      for (const node_id operand : n.operands) depends(id, operand);
      if (n.kind != operation::memory_read && n.kind != operation::memory_write) continue;
      if (last_write[n.object] != none) depends(id, last_write[n.object]);
      if (n.kind == operation::memory_read) {
        reads_since[n.object].push_back(id);
      } else {
        for (const node_id earlier : reads_since[n.object]) depends(id, earlier);
        reads_since[n.object].clear();
        last_write[n.object] = id;
      }
    }
  }

  opcode opcode_of(const node& n) const {
    if (n.kind == operation::read) return opcode::read;
    if (n.kind == operation::memory_read) return opcode::memory_read;
    if (n.kind == operation::memory_write) return opcode::memory_write;
    if (n.kind == operation::slice && narrow(n) && !operands_narrow(n)) return opcode::slice_of_wide;
    if (!narrow(n) || !operands_narrow(n)) return opcode::wide;
    switch (n.kind) {
      case operation::table:
        return opcode::table;
      case operation::concat:
        return opcode::concat;
      case operation::slice:
        return opcode::slice;
      case operation::extend_sign:
        return opcode::extend_sign;
      default:
        // The remaining narrow operations stand in the same order in both enumerations.
        static_assert(static_cast<int>(opcode::select) ==
                      static_cast<int>(operation::select) - static_cast<int>(operation::add));
        return static_cast<opcode>(static_cast<int>(n.kind) - static_cast<int>(operation::add));
    }
  }

  /// Emits ready nodes in runs of equal opcodes, each time the opcode with most nodes ready.
  void emit_batches() {
    std::array<std::vector<node_id>, static_cast<std::size_t>(opcode::count)> ready;
    std::vector<node_id> wires;  // narrow zero extensions take no instruction: they share their operand's place
    const auto enlist = [&](node_id id) {
      const node& n = g.nodes[id];
      if (n.kind == operation::extend_zero && narrow(n))
        wires.push_back(id);
      else
        ready[static_cast<std::size_t>(opcode_of(n))].push_back(id);
    };
    const auto release = [&](node_id id) {
      for (const node_id user : users[id])
        if (--missing[user] == 0) enlist(user);
    };
    const auto settle_wires = [&] {
      while (!wires.empty()) {
        const node_id wire = wires.back();
        wires.pop_back();
        where[wire] = {where[g.nodes[wire].operands[0]].offset, g.nodes[wire].width};
        release(wire);
      }
    };
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (!is_fixed(g.nodes[id]) && !is_late(id) && missing[id] == 0) enlist(id);
    settle_wires();
    for (;;) {
      const auto fullest = std::max_element(ready.begin(), ready.end(),
                                            [](const auto& a, const auto& b) { return a.size() < b.size(); });
      if (fullest->empty()) break;
      batch b{static_cast<opcode>(fullest - ready.begin()), static_cast<std::uint32_t>(t.instructions_.size()), 0};
      for (std::size_t i = 0; i < fullest->size(); ++i) {  // grows while it runs
        const node_id id = (*fullest)[i];
        emit(b.what, id);
        release(id);
        settle_wires();
      }
      fullest->clear();
      b.end = static_cast<std::uint32_t>(t.instructions_.size());
      t.batches_.push_back(b);
    }
  }

  std::uint32_t offset(node_id id) const { return where[id].offset; }

  void emit(opcode what, node_id id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::memory_write) where[id] = allocate(n.width);
    instruction i;
    if (n.kind != operation::memory_write) i.result = offset(id);
    i.result_shift = static_cast<std::uint8_t>(word_bits - std::min(n.width, word_bits));
    switch (what) {
      case opcode::read:
        i.a = static_cast<std::uint32_t>(t.reads_.size());
        t.reads_.push_back({n.object, offset(n.operands[0]), where[id]});
        break;
      case opcode::memory_read:
      case opcode::memory_write:
        i.a = static_cast<std::uint32_t>(t.memory_accesses_.size());
        t.memory_accesses_.push_back(access_of(id));
        break;
      case opcode::wide: {
        i.a = static_cast<std::uint32_t>(t.wide_.size());
        wide_instruction w{n.kind, n.low, where[id], {}, n.object};
        for (const node_id operand : n.operands) w.operands.push_back(where[operand]);
        t.wide_.push_back(std::move(w));
        break;
      }
      case opcode::concat:
        emit_concat(n, i);
        return;
      default: {
        if (!n.operands.empty()) i.a = offset(n.operands[0]);
        if (n.operands.size() > 1) i.b = offset(n.operands[1]);
        if (n.operands.size() > 2) i.c = offset(n.operands[2]);
        const unsigned width = where[n.operands[0]].width;
        i.operand_shift = static_cast<std::uint8_t>(word_bits - std::min(width, word_bits));
        if (what == opcode::slice) i.operand_shift = static_cast<std::uint8_t>(n.low);
        if (what == opcode::slice_of_wide) {
          i.a += n.low / word_bits;
          i.operand_shift = static_cast<std::uint8_t>(n.low % word_bits);
        }
        if (what == opcode::table) i.b = n.object;
      }
    }
    t.instructions_.push_back(i);
  }

  /// A narrow concat of n operands is n - 1 instructions (high << width of low | low) with one accumulator.
  void emit_concat(const node& n, instruction i) {
    std::uint32_t high = offset(n.operands[0]);
    for (std::size_t k = 1; k < n.operands.size(); ++k) {
      i.a = high;
      i.b = offset(n.operands[k]);
      i.operand_shift = static_cast<std::uint8_t>(where[n.operands[k]].width);
      t.instructions_.push_back(i);
      high = i.result;
    }
  }

  memory_access access_of(node_id id) const {
    const node& n = g.nodes[id];
    const bool read = n.kind == operation::memory_read;
    return {n.object, where[n.operands[0]], read ? where[id] : where[n.operands[1]], offset(n.operands[read ? 1 : 2])};
  }

  void place_effects() {
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      if (!is_late(id)) continue;
      const node& n = g.nodes[id];
      if (n.kind == operation::write)
        t.writes_.push_back({n.object, offset(n.operands[0]), where[n.operands[1]]});
      else
        t.late_writes_.push_back(access_of(id));
    }
    for (register_id id = 0; id < g.registers.size(); ++id) {
      const location& value = t.registers_[id].value;
      const register_update update{value.offset, offset(g.registers[id].next), offset(g.registers[id].enable),
                                   words_for(value.width)};
      (update.words == 1 ? t.narrow_updates_ : t.wide_updates_).push_back(update);
      if (g.registers[id].patient) t.patient_registers_.emplace_back(id, update.enable);
      t.staged_.resize(t.staged_.size() + update.words);
    }
    if (g.patient != none) t.patient_ = offset(g.patient);
  }

  interpreter& t;
  const graph& g;
  std::vector<location> where;              // of each node's value
  std::vector<std::vector<node_id>> users;  // and memory accesses that must follow
  std::vector<unsigned> missing;            // operands not emitted yet
  std::vector<node_id> last_read;           // of each memory
};

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
  translator(*this, g).run();
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
  for (const batch& b : batches_) {
    if (execute(b)) continue;
    roll_back();
    return broken_.empty() ? outcome::blocked : outcome::broken_promise;
  }
  if (!patient_registers_.empty() && !check_patience()) {
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

bool interpreter::execute(const batch& b) {
  word* const v = values_.data();
  const instruction* i = instructions_.data() + b.begin;
  const instruction* const end = instructions_.data() + b.end;
  const auto for_each = [&](auto compute) {
    for (; i != end; ++i) v[i->result] = compute(*i);
  };
  const auto wrapped = [&](auto compute) {  // the result keeps the low bits only
    for (; i != end; ++i) v[i->result] = (compute(*i) << i->result_shift) >> i->result_shift;
  };
  const auto narrow_signed = [&](std::uint32_t offset, const instruction& n) {
    return as_signed(sign_extended(v[offset], n.operand_shift));
  };
  switch (b.what) {
    case opcode::add:
      wrapped([&](const instruction& n) { return v[n.a] + v[n.b]; });
      break;
    case opcode::subtract:
      wrapped([&](const instruction& n) { return v[n.a] - v[n.b]; });
      break;
    case opcode::multiply:
      wrapped([&](const instruction& n) { return v[n.a] * v[n.b]; });
      break;
    case opcode::add_or_subtract:
      wrapped([&](const instruction& n) { return v[n.c] != 0 ? v[n.a] - v[n.b] : v[n.a] + v[n.b]; });
      break;
    case opcode::divide_unsigned:
      wrapped([&](const instruction& n) { return v[n.b] == 0 ? ~word{0} : v[n.a] / v[n.b]; });
      break;
    case opcode::divide_signed:
      wrapped([&](const instruction& n) {
        const std::int64_t divisor = narrow_signed(n.b, n);
        if (divisor == 0) return ~word{0};
        if (divisor == -1) return word{0} - v[n.a];  // the most negative value wraps
        return static_cast<word>(narrow_signed(n.a, n) / divisor);
      });
      break;
    case opcode::remainder_unsigned:
      for_each([&](const instruction& n) { return v[n.b] == 0 ? v[n.a] : v[n.a] % v[n.b]; });
      break;
    case opcode::remainder_signed:
      wrapped([&](const instruction& n) {
        const std::int64_t divisor = narrow_signed(n.b, n);
        if (divisor == 0) return v[n.a];
        if (divisor == -1) return word{0};
        return static_cast<word>(narrow_signed(n.a, n) % divisor);
      });
      break;
    case opcode::bit_and:
      for_each([&](const instruction& n) { return v[n.a] & v[n.b]; });
      break;
    case opcode::bit_or:
      for_each([&](const instruction& n) { return v[n.a] | v[n.b]; });
      break;
    case opcode::bit_xor:
      for_each([&](const instruction& n) { return v[n.a] ^ v[n.b]; });
      break;
    case opcode::bit_not:
      wrapped([&](const instruction& n) { return ~v[n.a]; });
      break;
    case opcode::shift_left:
      wrapped([&](const instruction& n) { return v[n.b] >= word_bits ? word{0} : v[n.a] << v[n.b]; });
      break;
    case opcode::shift_right_logical:
      for_each([&](const instruction& n) { return v[n.b] >= word_bits ? word{0} : v[n.a] >> v[n.b]; });
      break;
    case opcode::shift_right_arithmetic:
      wrapped([&](const instruction& n) {
        return static_cast<word>(narrow_signed(n.a, n) >> std::min<word>(v[n.b], word_bits - 1));
      });
      break;
    case opcode::equal:
      for_each([&](const instruction& n) { return word{v[n.a] == v[n.b]}; });
      break;
    case opcode::less_unsigned:
      for_each([&](const instruction& n) { return word{v[n.a] < v[n.b]}; });
      break;
    case opcode::less_signed:
      for_each([&](const instruction& n) {
        return word{as_signed(v[n.a] << n.operand_shift) < as_signed(v[n.b] << n.operand_shift)};
      });
      break;
    case opcode::select:
      for_each([&](const instruction& n) { return v[n.a] != 0 ? v[n.b] : v[n.c]; });
      break;
    case opcode::concat:
      for_each([&](const instruction& n) { return v[n.a] << n.operand_shift | v[n.b]; });
      break;
    case opcode::slice:
      wrapped([&](const instruction& n) { return v[n.a] >> n.operand_shift; });
      break;
    case opcode::extend_sign:
      wrapped([&](const instruction& n) { return sign_extended(v[n.a], n.operand_shift); });
      break;
    case opcode::table:
      for_each([&](const instruction& n) {
        const table_state& t = tables_[n.b];
        return v[n.a] < t.count ? t.words[v[n.a]] : 0;
      });
      break;
    case opcode::slice_of_wide:
      for_each([&](const instruction& n) { return extract(v + n.a, n.operand_shift, word_bits - n.result_shift); });
      break;
    case opcode::wide:
      for (; i != end; ++i) execute_wide(wide_[i->a]);
      break;
    case opcode::read:
      for (; i != end; ++i)
        if (!execute_read(reads_[i->a])) return false;
      break;
    case opcode::memory_read:
      for (; i != end; ++i)
        if (!execute_memory_read(memory_accesses_[i->a])) return false;
      break;
    case opcode::memory_write:
      for (; i != end; ++i) execute_memory_write(memory_accesses_[i->a], true);
      break;
    case opcode::count:
      break;
  }
  return true;
}

/// Movements of bits are done in place, word by word; arithmetic on wide values goes through APInt.
void interpreter::execute_wide(const wide_instruction& w) {
  word* const v = values_.data();
  word* const result = v + w.result.offset;
  const std::uint32_t size = words_for(w.result.width);
  const auto operand = [&](std::size_t k) { return v + w.operands[k].offset; };
  switch (w.kind) {
    case operation::concat: {
      std::fill_n(result, size, 0);
      unsigned low = w.result.width;
      for (std::size_t k = 0; k < w.operands.size(); ++k) {
        low -= w.operands[k].width;
        deposit(result, low, w.operands[k].width, operand(k));
      }
      return;
    }
    case operation::slice:
      for (unsigned done = 0; done < w.result.width; done += word_bits)
        result[done / word_bits] = extract(operand(0), w.low + done, std::min(word_bits, w.result.width - done));
      return;
    case operation::select:
      std::copy_n(operand(v[w.operands[0].offset] != 0 ? 1 : 2), size, result);
      return;
    case operation::extend_zero: {
      const std::uint32_t filled = words_for(w.operands[0].width);
      std::copy_n(operand(0), filled, result);
      std::fill(result + filled, result + size, 0);
      return;
    }
    case operation::equal:
      *result = std::equal(operand(0), operand(0) + words_for(w.operands[0].width), operand(1));
      return;
    case operation::bit_and:
      for (std::uint32_t k = 0; k < size; ++k) result[k] = operand(0)[k] & operand(1)[k];
      return;
    case operation::bit_or:
      for (std::uint32_t k = 0; k < size; ++k) result[k] = operand(0)[k] | operand(1)[k];
      return;
    case operation::bit_xor:
      for (std::uint32_t k = 0; k < size; ++k) result[k] = operand(0)[k] ^ operand(1)[k];
      return;
    case operation::table: {
      const table_state& t = tables_[w.table];
      const std::uint64_t address = load(w.operands[0]).getLimitedValue();
      if (address < t.count)
        std::copy_n(&t.words[address * size], size, result);
      else
        std::fill_n(result, size, 0);
      return;
    }
    default: {
      std::vector<llvm::APInt> operands;
      operands.reserve(w.operands.size());
      for (const location& where : w.operands) operands.push_back(load(where));
      store(w.result, evaluate(w.kind, w.result.width, w.low, operands));
    }
  }
}

bool interpreter::execute_read(const port_access& access) {
  const queue& q = queues_[access.port];
  word* const result = &values_[access.token.offset];
  if (values_[access.predicate] == 0) {
    std::fill_n(result, q.words_a_token, 0);
    return true;
  }
  if (q.head == q.words.size()) {
    blocked_on_ = access.port;
    return false;
  }
  std::copy_n(&q.words[q.head], q.words_a_token, result);  // taken from the queue in commit()
  return true;
}

/// False when the address is past the memory's end.
bool interpreter::address_of(const memory_access& access, std::uint64_t& address) const {
  address = access.address.width <= word_bits ? values_[access.address.offset] : load(access.address).getLimitedValue();
  return address < memories_[access.memory].words;
}

bool interpreter::execute_memory_read(const memory_access& access) {
  const memory_state& m = memories_[access.memory];
  word* const result = &values_[access.data.offset];
  std::uint64_t address = 0;
  if (values_[access.enable] == 0 || !address_of(access, address)) {
    std::fill_n(result, m.words_a_word, 0);
    return true;
  }
  std::copy_n(&m.contents[address * m.words_a_word], m.words_a_word, result);
  if (m.distance == 1) return true;
  // A write of this very iteration hides nothing: the promise is about the write before it.
  std::uint64_t written = m.written[address];
  const bool overwritten = written == iterations_ + 1;
  if (overwritten) {
    const auto first = std::find_if(undo_.begin(), undo_.end(), [&](const undo_entry& e) {
      return e.memory == access.memory && e.address == address;
    });
    written = first->stamp;
  }
  if (written == 0 || iterations_ + 1 - written >= m.distance) return true;
  if (m.promised) {
    broken_ = fmt::format(
        "iteration {}: memory '{}'{}: word {} is read {} iteration{} after it was written, but the source promises a "
        "distance of at least {}",
        iterations_, m.name, m.place, address, iterations_ + 1 - written, iterations_ + 1 - written == 1 ? "" : "s",
        m.distance);
    return false;
  }
  if (!overwritten) store(access.data, ~load(access.data));
  return true;
}

void interpreter::execute_memory_write(const memory_access& access, bool undoable) {
  std::uint64_t address = 0;
  if (values_[access.enable] == 0 || !address_of(access, address)) return;
  memory_state& m = memories_[access.memory];
  word* const target = &m.contents[address * m.words_a_word];
  if (undoable) {
    undo_.push_back({access.memory, address, m.written.empty() ? 0 : m.written[address], undo_words_.size()});
    undo_words_.insert(undo_words_.end(), target, target + m.words_a_word);
  }
  std::copy_n(&values_[access.data.offset], m.words_a_word, target);
  if (!m.written.empty()) m.written[address] = iterations_ + 1;
}

bool interpreter::check_patience() {
  if (patient_ != none && values_[patient_] != 0) return true;
  for (const auto& [id, enable] : patient_registers_) {
    if (values_[enable] == 0) continue;
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
  for (const memory_access& access : late_writes_) execute_memory_write(access, false);
  for (const port_access& access : reads_) {
    if (values_[access.predicate] == 0) continue;
    queue& q = queues_[access.port];
    q.drop_oldest();
  }
  for (const port_access& access : writes_) {
    if (values_[access.predicate] == 0) continue;
    queue& q = queues_[access.port];
    const auto token = values_.begin() + access.token.offset;
    q.words.insert(q.words.end(), token, token + q.words_a_token);
  }
  // All at once: a register's next value may be another register's old one.
  word* const v = values_.data();
  word* staged = staged_.data();
  for (const register_update& r : narrow_updates_) *staged++ = v[v[r.enable] != 0 ? r.next : r.value];
  for (const register_update& r : wide_updates_)
    staged = std::copy_n(v + (v[r.enable] != 0 ? r.next : r.value), r.words, staged);
  const word* from = staged_.data();
  for (const register_update& r : narrow_updates_) v[r.value] = *from++;
  for (const register_update& r : wide_updates_) {
    std::copy_n(from, r.words, v + r.value);
    from += r.words;
  }
  ++iterations_;
}

llvm::APInt interpreter::load(location where) const {
  return {where.width, llvm::ArrayRef<word>(&values_[where.offset], words_for(where.width))};
}

void interpreter::store(location where, const llvm::APInt& value) {
  std::copy_n(value.getRawData(), words_for(where.width), &values_[where.offset]);
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
