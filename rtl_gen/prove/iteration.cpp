#include "prove/iteration.hpp"

#include <stdexcept>

#include "prove/terms.hpp"

namespace epiline::prove {

using namespace dataflow;

unsigned index_width(unsigned words) { return words <= 1 ? 1 : llvm::APInt(64, words - 1).getActiveBits(); }

word_place place_of(const z3::expr& address, unsigned words) {
  z3::context& solver = address.ctx();
  const unsigned width = address.get_sort().bv_size(), wide = std::max(width, 33u);
  const bool always = width < 32 && (std::uint64_t{1} << width) <= words;
  const z3::expr inside =
      always ? solver.bool_val(true) : z3::ult(resized(address, wide), solver.bv_val(std::uint64_t{words}, wide));
  return {resized(address, index_width(words)), inside};
}

iteration::iteration(z3::context& solver, const graph& g, const start_state& start, const replacement& replace)
    : solver_(solver), g_(g), start_(start), writes_(g.memories.size()), access_(g.ports.size(), none) {
  nodes_.reserve(g.nodes.size());
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const dataflow::node& n = g.nodes[id];
    if (n.kind == operation::read || n.kind == operation::write) access_[n.object] = id;
    z3::expr term = term_of(n);
    if (replace && n.width != 0)
      if (const std::optional<z3::expr> other = replace(id, term)) term = *other;
    nodes_.push_back(term);
  }
}

z3::expr iteration::term_of(const dataflow::node& n) {
  switch (n.kind) {
    case operation::constant:
      return constant_term(solver_, n.value);
    case operation::read:
      return z3::ite(is_one(operand(n, 0)), start_.tokens[n.object], solver_.bv_val(0, n.width));
    case operation::register_value:
      return start_.registers[n.object];
    case operation::memory_read:
      return read_word(n);
    case operation::memory_write: {
      const word_place at = place_of(operand(n, 0), g_.memories[n.object].words);
      writes_[n.object].push_back({is_one(operand(n, 2)) && at.inside, at.index, operand(n, 1)});
      return solver_.bool_val(true);  // stands for no value
    }
    case operation::write:
      return solver_.bool_val(true);
    case operation::table: {
      const auto words = static_cast<unsigned>(g_.tables[n.object].values.size());
      const z3::expr zero = solver_.bv_val(0, n.width);
      if (words == 0) return zero;
      const word_place at = place_of(operand(n, 0), words);
      return z3::ite(at.inside, start_.table_word(n.object, at.index), zero);
    }
    default:
      return pure(n);
  }
}

z3::expr iteration::read_word(const dataflow::node& n) {
  const memory_id m = n.object;
  const word_place at = place_of(operand(n, 0), g_.memories[m].words);
  z3::expr word = start_.word(m, at.index);
  for (const word_write& recent : start_.recent_writes[m])
    word = z3::ite(recent.hits && recent.index == at.index, start_.stale_word(m, at.index), word);
  for (const word_write& write : writes_[m]) word = z3::ite(write.hits && write.index == at.index, write.data, word);
  return z3::ite(is_one(operand(n, 1)) && at.inside, word, solver_.bv_val(0, n.width));
}

z3::expr iteration::shifted(const dataflow::node& n) {
  const z3::expr &a = operand(n, 0), &amount = operand(n, 1);
  const unsigned given = amount.get_sort().bv_size();
  z3::expr fitting = resized(amount, n.width);
  if (given > n.width) {  // what does not fit shifts all out, as all ones do
    const z3::expr high = bits_of(amount, n.width, given - n.width);
    fitting = z3::ite(high == solver_.bv_val(0, given - n.width), fitting, ~solver_.bv_val(0, n.width));
  }
  if (n.kind == operation::shift_left) return z3::shl(a, fitting);
  return n.kind == operation::shift_right_logical ? z3::lshr(a, fitting) : z3::ashr(a, fitting);
}

z3::expr iteration::pure(const dataflow::node& n) {
  const z3::expr& a = operand(n, 0);
  switch (n.kind) {
    case operation::add:
      return a + operand(n, 1);
    case operation::subtract:
      return a - operand(n, 1);
    case operation::multiply:
      return a * operand(n, 1);
    case operation::add_or_subtract:
      return z3::ite(is_one(operand(n, 2)), a - operand(n, 1), a + operand(n, 1));
    case operation::divide_unsigned:  // by 0: all ones, in SMT-LIB as here
      return z3::udiv(a, operand(n, 1));
    case operation::divide_signed:
      return z3::ite(operand(n, 1) == solver_.bv_val(0, n.width), ~solver_.bv_val(0, n.width), a / operand(n, 1));
    case operation::remainder_unsigned:
      return z3::urem(a, operand(n, 1));
    case operation::remainder_signed:
      return z3::srem(a, operand(n, 1));
    case operation::bit_and:
      return a & operand(n, 1);
    case operation::bit_or:
      return a | operand(n, 1);
    case operation::bit_xor:
      return a ^ operand(n, 1);
    case operation::bit_not:
      return ~a;
    case operation::shift_left:
    case operation::shift_right_logical:
    case operation::shift_right_arithmetic:
      return shifted(n);
    case operation::equal:
      return as_bit(a == operand(n, 1));
    case operation::less_unsigned:
      return as_bit(z3::ult(a, operand(n, 1)));
    case operation::less_signed:
      return as_bit(z3::slt(a, operand(n, 1)));
    case operation::select:
      return z3::ite(is_one(a), operand(n, 1), operand(n, 2));
    case operation::concat: {
      z3::expr_vector parts(solver_);
      for (std::size_t i = 0; i < n.operands.size(); ++i) parts.push_back(operand(n, i));
      return z3::concat(parts);
    }
    case operation::slice:
      return bits_of(a, n.low, n.width);
    case operation::extend_zero:
      return resized(a, n.width);
    case operation::extend_sign:
      return z3::sext(a, n.width - a.get_sort().bv_size());
    default:
      throw std::logic_error("prove: an operation without a term");
  }
}

z3::expr iteration::accesses(port_id port) const {
  return access_[port] == none ? solver_.bool_val(false) : is_one(operand(g_.nodes[access_[port]], 0));
}

z3::expr iteration::token(port_id port) const {
  return access_[port] == none ? solver_.bv_val(0, g_.ports[port].width) : operand(g_.nodes[access_[port]], 1);
}

z3::expr iteration::register_after(register_id id) const {
  const register_state& r = g_.registers[id];
  return z3::ite(is_one(nodes_[r.enable]), nodes_[r.next], start_.registers[id]);
}

z3::expr iteration::word_after(memory_id id, const z3::expr& index) const {
  z3::expr word = start_.word(id, index);
  for (const word_write& write : writes_[id]) word = z3::ite(write.hits && write.index == index, write.data, word);
  return word;
}

}  // namespace epiline::prove
