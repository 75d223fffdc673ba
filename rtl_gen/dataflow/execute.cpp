// interpreter.hpp: what the instructions of an iteration do.

#include <fmt/format.h>

#include <algorithm>

#include "dataflow/evaluate.hpp"
#include "dataflow/interpreter.hpp"

namespace epiline::dataflow {

bool interpreter::execute(const batch& b) {
  word* const v = program_.values.data();
  const instruction* i = program_.instructions.data() + b.begin;
  const instruction* const end = program_.instructions.data() + b.end;
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
      for (; i != end; ++i) execute_wide(program_.wide[i->a]);
      break;
    case opcode::read:
      for (; i != end; ++i)
        if (!execute_read(program_.reads[i->a])) return false;
      break;
    case opcode::memory_read:
      for (; i != end; ++i)
        if (!execute_memory_read(program_.memory_accesses[i->a])) return false;
      break;
    case opcode::memory_write:
      for (; i != end; ++i) execute_memory_write(program_.memory_accesses[i->a], true);
      break;
    case opcode::count:
      break;
  }
  return true;
}

/// Movements of bits are done in place, word by word; arithmetic on wide values goes through APInt.
void interpreter::execute_wide(const wide_instruction& w) {
  word* const v = program_.values.data();
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
  word* const result = &program_.values[access.token.offset];
  if (program_.values[access.predicate] == 0) {
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
  address = access.address.width <= word_bits ? program_.values[access.address.offset]
                                              : load(access.address).getLimitedValue();
  return address < memories_[access.memory].words;
}

bool interpreter::execute_memory_read(const memory_access& access) {
  const memory_state& m = memories_[access.memory];
  word* const result = &program_.values[access.data.offset];
  std::uint64_t address = 0;
  if (program_.values[access.enable] == 0 || !address_of(access, address)) {
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
  if (program_.values[access.enable] == 0 || !address_of(access, address)) return;
  memory_state& m = memories_[access.memory];
  word* const target = &m.contents[address * m.words_a_word];
  if (undoable) {
    undo_.push_back({access.memory, address, m.written.empty() ? 0 : m.written[address], undo_words_.size()});
    undo_words_.insert(undo_words_.end(), target, target + m.words_a_word);
  }
  std::copy_n(&program_.values[access.data.offset], m.words_a_word, target);
  if (!m.written.empty()) m.written[address] = iterations_ + 1;
}

}  // namespace epiline::dataflow
