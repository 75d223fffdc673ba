#pragma once
// ap_fixed<W, I, Q, O> and ap_ufixed: numbers of W bits, I of them before the binary point (the sign included), with
// the vendors' names and meaning: the value is that of the W bits as an integer, V, times 2^(I - W). I may be negative,
// or more than W. Every operator has the exact mathematical result, in a type wide enough to hold it (F = W - I
// fraction bits; W2, I2, F2, S2: of b; n = max(I + (S2 && !S), I2 + (S && !S2)) integer bits that hold both):
//
//   a + b     n + 1 + max(F, F2) bits, n + 1 of them before the point, signed if either is
//   a - b     the same bits, always signed
//   a * b     W + W2 bits, I + I2 before the point, signed if either is
//   a / b     W + max(F2, 0) + S2 bits, I + F2 + S2 before the point; cut toward zero
//   & | ^     n + max(F, F2) bits, n before the point
//   -a        W + 1 bits, signed;   ~a   the type of a
//   << >>     type of a: the bits move, those shifted out are lost
//   compares  by value; also with a floating point constant
//
// An ap_int or a C integer takes part as a number without fraction. What is assigned keeps its value where the target
// has the bits for it. Fraction bits that the target does not have are rounded off as Q says, and what is too large for
// it is changed as O says:
//
//   AP_TRN (default)  toward minus infinity     AP_RND           nearest, halves toward plus infinity
//   AP_TRN_ZERO       toward zero               AP_RND_INF       nearest, halves away from zero
//   AP_RND_CONV       nearest, halves to even   AP_RND_MIN_INF   nearest, halves toward minus infinity
//                                               AP_RND_ZERO      nearest, halves toward zero
//
//   AP_WRAP (default) keeps the low bits        AP_SAT           the nearest value there is
//   AP_SAT_ZERO       zero                      AP_SAT_SYM       as AP_SAT, and never less than minus the largest value
//
// AP_WRAP_SM and saturation bits (N) are not supported. A conversion to an integer cuts toward zero, as C's do.
//
// Hardware has no floating point: a constant like ap_fixed<16, 2>(0.7071) is converted by the compiler.

#include <ap_int.h>

enum ap_q_mode { AP_RND, AP_RND_ZERO, AP_RND_MIN_INF, AP_RND_INF, AP_RND_CONV, AP_TRN, AP_TRN_ZERO };
enum ap_o_mode { AP_SAT, AP_SAT_ZERO, AP_SAT_SYM, AP_WRAP, AP_WRAP_SM };

namespace epiline::ap {

template <int W, int I, bool S, ap_q_mode Q = AP_TRN, ap_o_mode O = AP_WRAP, int N = 0>
class ap_fixed_base;

namespace detail {

/// `v` times 2^-drop, rounded: one bit wider than what is left, at least two.
template <ap_q_mode Q, int drop, int W, bool S>
constexpr auto rounded(const ap_int_base<W, S>& v) {
  constexpr int wide = larger(W, drop + 1) + 1;  // so that every bit looked at exists
  const ap_int_base<wide, S> all(v);
  const ap_int_base<wide - drop, S> below(all >> drop);
  const bool half = all.test(drop - 1);
  bool rest = false;
  if constexpr (drop > 1) rest = ap_int_base<drop - 1, false>(all).to_bool();
  const bool negative = v.sign();
  bool up = false;
  if constexpr (Q == AP_TRN_ZERO) up = negative && (half || rest);
  if constexpr (Q == AP_RND) up = half;
  if constexpr (Q == AP_RND_ZERO) up = half && (rest || negative);
  if constexpr (Q == AP_RND_MIN_INF) up = half && rest;
  if constexpr (Q == AP_RND_INF) up = half && (rest || !negative);
  if constexpr (Q == AP_RND_CONV) up = half && (rest || below.test(0));
  return ap_int_base<wide - drop, S>(below + ap_int_base<1, false>(up));
}

/// `v` in W bits, by the overflow mode.
template <int W, bool S, ap_o_mode O, int WV, bool SV>
constexpr ap_int_base<W, S> limited(const ap_int_base<WV, SV>& v) {
  if constexpr (O == AP_WRAP) {
    return ap_int_base<W, S>(v);
  } else {
    // All ones but for the sign, which an unsigned number does not have.
    const ap_int_base<W, S> most(ap_int_base<W, false>(~ap_int_base<W, false>(0)) >> (S ? 1 : 0));
    ap_int_base<W, S> least(0);
    if constexpr (S) least = O == AP_SAT_SYM ? ap_int_base<W, S>(-most) : ap_int_base<W, S>(~most);
    if (v > most) return O == AP_SAT_ZERO ? ap_int_base<W, S>(0) : most;
    if (v < least) return O == AP_SAT_ZERO ? ap_int_base<W, S>(0) : least;
    return ap_int_base<W, S>(v);
  }
}

/// An integer times 2^-FV as the integer that stands for it with F fraction bits.
template <int W, bool S, int F, ap_q_mode Q, ap_o_mode O, int FV, int WV, bool SV>
constexpr ap_int_base<W, S> fitted(const ap_int_base<WV, SV>& v) {
  if constexpr (FV > F) {
    return limited<W, S, O>(rounded<Q, FV - F>(v));
  } else {
    return limited<W, S, O>(ap_int_base<WV + F - FV, SV>(v) << (F - FV));
  }
}

template <int W, int I, bool S, ap_q_mode Q, ap_o_mode O, int N>
std::true_type probe_fixed(const ap_fixed_base<W, I, S, Q, O, N>*);
std::false_type probe_fixed(const void*);
template <class T>
inline constexpr bool is_fixed = decltype(probe_fixed(static_cast<const std::decay_t<T>*>(nullptr)))::value;
template <class A, class B>
inline constexpr bool are_fixed_operands =
    (is_fixed<A> && (is_fixed<B> || is_operand<B>)) || (is_fixed<B> && is_operand<A>);

}  // namespace detail

/// The number itself; ap_fixed is signed, ap_ufixed is not.
template <int W, int I, bool S, ap_q_mode Q, ap_o_mode O, int N>
class ap_fixed_base {
  static_assert(O != AP_WRAP_SM && N == 0, "AP_WRAP_SM and saturation bits are not supported: use AP_WRAP or AP_SAT");

 public:
  static constexpr int width = W;
  static constexpr int iwidth = I;
  static constexpr int fraction = W - I;
  static constexpr bool is_signed = S;
  static constexpr ap_q_mode qmode = Q;
  static constexpr ap_o_mode omode = O;

  /// Result types of operators with an ap_fixed_base<W2, I2, S2> on the right.
  template <int W2, int I2, bool S2>
  struct RType {
    static constexpr int F = W - I;
    static constexpr int F2 = W2 - I2;
    static constexpr int both = detail::larger(I + (S2 && !S), I2 + (S && !S2));
    using plus = ap_fixed_base<both + 1 + detail::larger(F, F2), both + 1, S || S2>;
    using minus = ap_fixed_base<both + 1 + detail::larger(F, F2), both + 1, true>;
    using mult = ap_fixed_base<W + W2, I + I2, S || S2>;
    using div = ap_fixed_base<W + detail::larger(F2, 0) + S2, I + F2 + S2, S || S2>;
    using logic = ap_fixed_base<both + detail::larger(F, F2), both, S || S2>;
  };

  ap_int_base<W, S> V;  // the bits, as an integer

  ap_fixed_base() = default;
  template <int W2, int I2, bool S2, ap_q_mode Q2, ap_o_mode O2, int N2>
  constexpr ap_fixed_base(const ap_fixed_base<W2, I2, S2, Q2, O2, N2>& v)
      : V(detail::fitted<W, S, fraction, Q, O, W2 - I2>(v.V)) {}
  template <class T, std::enable_if_t<detail::is_ap<T>, int> = 0>
  constexpr ap_fixed_base(const T& v) : V(detail::fitted<W, S, fraction, Q, O, 0>(detail::value_of(v))) {}
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_fixed_base(T v) : V(detail::fitted<W, S, fraction, Q, O, 0>(detail::value_of(v))) {}
  /// Of a constant, in hardware. Not a number counts as zero, infinity as more than any number.
  template <class T, std::enable_if_t<std::is_floating_point_v<T>, int> = 0>
  constexpr ap_fixed_base(T v) : V(of_floating(static_cast<double>(v))) {}

  /// From the W bits as they are.
  static constexpr ap_fixed_base from_bits(const ap_int_base<W, S>& bits) {
    ap_fixed_base made(0);
    made.V = bits;
    return made;
  }

  /// Cut toward zero.
  constexpr auto to_ap_int_base() const {
    constexpr int bits = detail::larger(I, 1) + 1;
    return ap_int_base<detail::larger(I, 1), S>(detail::fitted<bits, S, 0, AP_TRN_ZERO, AP_WRAP, W - I>(V));
  }
  /// Conversions to integers cut toward zero and then keep the low bits; bool is "not zero".
  template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
  constexpr operator T() const {
    if constexpr (std::is_same_v<T, bool>) {
      return V.to_bool();
    } else {
      return static_cast<T>(ap_int_base<8 * sizeof(T), std::is_signed_v<T>>(to_ap_int_base()));
    }
  }
  template <int W2, bool S2>
  constexpr operator ap_int_base<W2, S2>() const {
    return ap_int_base<W2, S2>(to_ap_int_base());
  }
  constexpr int to_int() const { return static_cast<int>(*this); }
  constexpr unsigned to_uint() const { return static_cast<unsigned>(*this); }
  constexpr long to_long() const { return static_cast<long>(*this); }
  constexpr unsigned long to_ulong() const { return static_cast<unsigned long>(*this); }
  constexpr long long to_int64() const { return static_cast<long long>(*this); }
  constexpr unsigned long long to_uint64() const { return static_cast<unsigned long long>(*this); }
  // Of constants, in hardware.
  double to_double() const { return __builtin_ldexp(V.to_double(), -fraction); }
  float to_float() const { return static_cast<float>(to_double()); }
  template <class T, std::enable_if_t<std::is_floating_point_v<T>, int> = 0>
  operator T() const {
    return static_cast<T>(to_double());
  }

  static constexpr int length() { return W; }
  constexpr bool is_neg() const { return V.sign(); }
  constexpr bool is_zero() const { return V.is_zero(); }

  // Bits and ranges of V. Bit 0 is the lowest.
  constexpr auto operator[](int index) { return V[index]; }
  constexpr auto operator[](int index) const { return V[index]; }
  constexpr auto bit(int index) { return V[index]; }
  constexpr auto range(int high, int low) { return V.range(high, low); }
  constexpr auto range(int high, int low) const { return V.range(high, low); }
  constexpr auto range() { return V.range(); }
  constexpr auto range() const { return V.range(); }
  constexpr auto operator()(int high, int low) { return V.range(high, low); }
  constexpr auto operator()(int high, int low) const { return V.range(high, low); }

  constexpr bool operator!() const { return is_zero(); }
  constexpr ap_fixed_base operator+() const { return *this; }
  constexpr auto operator-() const { return ap_fixed_base<W + 1, I + 1, true>::from_bits(-V); }
  constexpr auto operator~() const { return ap_fixed_base<W, I, S>::from_bits(~V); }

#define EPILINE_AP_FIXED_ASSIGNMENT(symbol, compound)                \
  template <class T, std::enable_if_t<std::is_class_v<T>, int> = 0>  \
  constexpr ap_fixed_base& operator compound(const T & v) {          \
    return *this = *this symbol v;                                   \
  }                                                                  \
  template <class T, std::enable_if_t<!std::is_class_v<T>, int> = 0> \
  constexpr ap_fixed_base& operator compound(T v) {                  \
    return *this = *this symbol v;                                   \
  }
  EPILINE_AP_FIXED_ASSIGNMENT(+, +=)
  EPILINE_AP_FIXED_ASSIGNMENT(-, -=)
  EPILINE_AP_FIXED_ASSIGNMENT(*, *=)
  EPILINE_AP_FIXED_ASSIGNMENT(/, /=)
  EPILINE_AP_FIXED_ASSIGNMENT(&, &=)
  EPILINE_AP_FIXED_ASSIGNMENT(|, |=)
  EPILINE_AP_FIXED_ASSIGNMENT(^, ^=)
  EPILINE_AP_FIXED_ASSIGNMENT(<<, <<=)
  EPILINE_AP_FIXED_ASSIGNMENT(>>, >>=)
#undef EPILINE_AP_FIXED_ASSIGNMENT
  template <class T, std::enable_if_t<detail::is_ap<T>, int> = 0>
  constexpr ap_fixed_base operator<<(const T& places) const {
    return from_bits(V << places);
  }
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_fixed_base operator<<(T places) const {
    return from_bits(V << places);
  }
  template <class T, std::enable_if_t<detail::is_ap<T>, int> = 0>
  constexpr ap_fixed_base operator>>(const T& places) const {
    return from_bits(V >> places);
  }
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_fixed_base operator>>(T places) const {
    return from_bits(V >> places);
  }
  constexpr ap_fixed_base& operator++() { return *this = *this + ap_int_base<1, false>(1); }
  constexpr ap_fixed_base& operator--() { return *this = *this - ap_int_base<1, false>(1); }
  constexpr ap_fixed_base operator++(int) {
    const ap_fixed_base old = *this;
    ++*this;
    return old;
  }
  constexpr ap_fixed_base operator--(int) {
    const ap_fixed_base old = *this;
    --*this;
    return old;
  }

 private:
  static constexpr ap_int_base<W, S> of_floating(double v) {
    const auto bits = __builtin_bit_cast(unsigned long long, v);
    const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
    const unsigned long long mantissa = bits << 12 >> 12;
    const bool negative = bits >> 63 != 0;
    if (exponent == 0x7ff && mantissa != 0) return ap_int_base<W, S>(0);
    ap_int_base<55, true> value(exponent == 0 ? mantissa : mantissa | 1ull << 52);  // times 2^(exponent - 1075)
    if (negative) value = -value;
    // As an integer with so many bits behind the point of V that what is cut off cannot make a difference.
    constexpr int more = 60;
    constexpr int wide = W + more + 60;
    int places = (exponent == 0 ? 1 : exponent) - 1075 + fraction + more;
    ap_int_base<wide, true> moved(value);
    if (places >= 0) {
      if (places > W + more + 2) {  // too large: what a wrapped number keeps is zero
        moved = O == AP_WRAP ? ap_int_base<wide, true>(0) : moved << (W + more + 2);
      } else {
        moved = moved << places;
      }
    } else {
      const bool lost = places < -54 ? value.to_bool() : ((moved >> -places) << -places) != moved;
      moved = moved >> (places < -54 ? 54 : -places);
      moved = moved | ap_int_base<1, false>(lost);  // not a half, nor nothing
    }
    return detail::fitted<W, S, 0, Q, O, more>(moved);
  }
};

namespace detail {

// The value an operand stands for, as an ap_fixed_base.
template <int W, int I, bool S, ap_q_mode Q, ap_o_mode O, int N>
constexpr ap_fixed_base<W, I, S> fixed_of(const ap_fixed_base<W, I, S, Q, O, N>& v) {
  return ap_fixed_base<W, I, S>::from_bits(v.V);
}
template <class T, std::enable_if_t<is_operand<T>, int> = 0>
constexpr auto fixed_of(const T& v) {
  using integer = value_type<T>;
  return ap_fixed_base<integer::width, integer::width, integer::is_signed>::from_bits(value_of(v));
}

template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto add(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::plus;
  return result::from_bits(result(a).V + result(b).V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto subtract(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::minus;
  return result::from_bits(result(a).V - result(b).V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto multiply(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::mult;
  return result::from_bits(a.V * b.V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto divide(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::div;
  constexpr int places = larger(WB - IB, 0);
  return result::from_bits((ap_int_base<WA + places, SA>(a.V) << places) / b.V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto bit_and(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::logic;
  return result::from_bits(result(a).V & result(b).V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto bit_or(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::logic;
  return result::from_bits(result(a).V | result(b).V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr auto bit_xor(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using result = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::logic;
  return result::from_bits(result(a).V ^ result(b).V);
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr bool equal(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using both = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::logic;
  return both(a).V == both(b).V;
}
template <int WA, int IA, bool SA, int WB, int IB, bool SB>
constexpr bool less(const ap_fixed_base<WA, IA, SA>& a, const ap_fixed_base<WB, IB, SB>& b) {
  using both = typename ap_fixed_base<WA, IA, SA>::template RType<WB, IB, SB>::logic;
  return both(a).V < both(b).V;
}

}  // namespace detail

#define EPILINE_AP_FIXED(symbol, function) \
  EPILINE_AP_OPERATOR(detail::are_fixed_operands, symbol, detail::function(detail::fixed_of(a), detail::fixed_of(b)))
EPILINE_AP_FIXED(+, add)
EPILINE_AP_FIXED(-, subtract)
EPILINE_AP_FIXED(*, multiply)
EPILINE_AP_FIXED(/, divide)
EPILINE_AP_FIXED(&, bit_and)
EPILINE_AP_FIXED(|, bit_or)
EPILINE_AP_FIXED(^, bit_xor)
#undef EPILINE_AP_FIXED

namespace detail {

// A constant to compare with `Other`s: between which two of them it lies, so half of the sum of both in as few bits as
// that takes. What is beyond all of them stays so.
template <class Other, class T>
constexpr auto comparable(const T& v) {
  if constexpr (std::is_floating_point_v<T>) {
    using other = decltype(fixed_of(std::declval<const Other&>()));
    using limit = ap_fixed_base<other::width + 3, other::iwidth + 3, true, AP_TRN, AP_SAT>;
    return ap_fixed_base<limit::width + 1, limit::iwidth, true>::from_bits(limit(v).V - limit(-v).V);
  } else {
    return fixed_of(v);
  }
}
template <class A, class B>
inline constexpr bool are_comparable = (is_fixed<A> && (is_fixed<B> || is_operand<B> || std::is_floating_point_v<B>)) ||
                                       (is_fixed<B> && (is_operand<A> || std::is_floating_point_v<A>));

}  // namespace detail

#define EPILINE_AP_FIXED_COMPARE(symbol, expression) EPILINE_AP_OPERATOR(detail::are_comparable, symbol, expression)
EPILINE_AP_FIXED_COMPARE(==, detail::equal(detail::comparable<B>(a), detail::comparable<A>(b)))
EPILINE_AP_FIXED_COMPARE(!=, !detail::equal(detail::comparable<B>(a), detail::comparable<A>(b)))
EPILINE_AP_FIXED_COMPARE(<, detail::less(detail::comparable<B>(a), detail::comparable<A>(b)))
EPILINE_AP_FIXED_COMPARE(>, detail::less(detail::comparable<A>(b), detail::comparable<B>(a)))
EPILINE_AP_FIXED_COMPARE(<=, !detail::less(detail::comparable<A>(b), detail::comparable<B>(a)))
EPILINE_AP_FIXED_COMPARE(>=, !detail::less(detail::comparable<B>(a), detail::comparable<A>(b)))
#undef EPILINE_AP_FIXED_COMPARE

#ifndef __SYNTHESIS__
template <int W, int I, bool S, ap_q_mode Q, ap_o_mode O, int N>
std::ostream& operator<<(std::ostream& out, const ap_fixed_base<W, I, S, Q, O, N>& v) {
  return out << v.to_double();
}
#endif

}  // namespace epiline::ap

template <int W, int I, ap_q_mode Q = AP_TRN, ap_o_mode O = AP_WRAP, int N = 0>
using ap_fixed = epiline::ap::ap_fixed_base<W, I, true, Q, O, N>;
template <int W, int I, ap_q_mode Q = AP_TRN, ap_o_mode O = AP_WRAP, int N = 0>
using ap_ufixed = epiline::ap::ap_fixed_base<W, I, false, Q, O, N>;
using epiline::ap::ap_fixed_base;
