#include "prove/terms.hpp"

#include <memory>

namespace epiline::prove {

using llvm::APInt;

z3::expr constant_term(z3::context& solver, const APInt& value) {
  const unsigned width = value.getBitWidth();
  if (width <= 64) return solver.bv_val(value.getZExtValue(), width);
  const auto bits = std::make_unique<bool[]>(width);
  for (unsigned i = 0; i < width; ++i) bits[i] = value[i];
  return solver.bv_val(width, bits.get());
}

APInt value_of(const z3::model& model, const z3::expr& term) {
  const z3::expr value = model.eval(term, true);
  const unsigned width = term.get_sort().bv_size();
  if (!value.is_numeral()) return APInt(width, 0);
  return APInt(width, value.get_decimal_string(0), 10);
}

z3::expr resized(const z3::expr& term, unsigned width) {
  const unsigned now = term.get_sort().bv_size();
  if (width == now) return term;
  return width < now ? term.extract(width - 1, 0) : z3::zext(term, width - now);
}

z3::expr bits_of(const z3::expr& term, unsigned low, unsigned width) {
  if (low == 0 && width == term.get_sort().bv_size()) return term;
  return term.extract(low + width - 1, low);
}

z3::expr is_one(const z3::expr& bit) { return bit == bit.ctx().bv_val(1, 1); }

z3::expr as_bit(const z3::expr& condition) {
  return z3::ite(condition, condition.ctx().bv_val(1, 1), condition.ctx().bv_val(0, 1));
}

z3::expr lies_in(const z3::expr& term, const passes::value_set& set) {
  z3::context& solver = term.ctx();
  z3::expr result = solver.bool_val(true);
  const APInt known = set.bits.Zero | set.bits.One;
  if (!known.isZero()) {
    const z3::expr kept = known.isAllOnes() ? term : (term & constant_term(solver, known));
    result = kept == constant_term(solver, set.bits.One);
  }
  if (!set.range.isFullSet() && !set.range.isEmptySet()) {
    const APInt size = set.range.getUpper() - set.range.getLower();  // of an interval that may wrap around
    const z3::expr inside = z3::ult(term - constant_term(solver, set.range.getLower()), constant_term(solver, size));
    result = known.isZero() ? inside : (result && inside);
  }
  return result;
}

bool is_restrictive(const passes::value_set& set) {
  return !(set.bits.Zero | set.bits.One).isZero() || (!set.range.isFullSet() && !set.range.isEmptySet());
}

}  // namespace epiline::prove
