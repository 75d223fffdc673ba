#pragma once
// hls:: mathematics of integers and fixed-point numbers, with the vendors' names. T: ap_int, ap_uint, ap_fixed,
// ap_ufixed or a C integer.
//
//   abs(x), fabs(x)          T; the most negative number stays what it is
//   min(a, b), max(a, b)     T; of two types, a type that holds both. Also fmin, fmax
//   sqrt(x)                  T, cut toward zero; a number below zero has 0
//   floor, ceil, trunc,      T, of fixed point: toward minus or plus infinity, toward zero,
//   round, rint              nearest with halves away from zero, nearest with halves to even;
//                            T's way with what it cannot hold (AP_WRAP, ...) applies
//   signbit(x)               bool, whether x is below zero
//   copysign(x, y)           T, |x| with the sign of y
//
// Everything else of the vendors' header (sin, exp, pow, ...), and all floating point, is refused where it is used.

#include <cmath>

#include "ap_fixed.h"
#include "ap_int.h"

namespace epiline::math {

using ap::detail::fixed_of;
using ap::detail::is_ap;
using ap::detail::is_c_integer;
using ap::detail::is_fixed;
using ap::detail::is_operand;
using ap::detail::value_type;

template <class T>
inline constexpr bool is_number = is_operand<T> || is_fixed<T>;

/// What a number of type T is computed as and given back: a proxy stands for its integer.
template <class T, bool = is_ap<T>>
struct number_type {
  using type = T;
};
template <class T>
struct number_type<T, true> {
  using type = value_type<T>;
};
template <class T>
using number = typename number_type<T>::type;

template <class T>
constexpr void check_number() {
  static_assert(!std::is_floating_point_v<T>, "floating point is not supported: use ap_fixed");
  static_assert(std::is_floating_point_v<T> || is_number<T>, "not a number: use ap_int, ap_fixed or a C integer");
}

template <class T>
constexpr number<T> as_number(const T& v) {
  check_number<T>();
  return number<T>(v);
}

/// A type that holds numbers of both.
template <class A, class B>
constexpr auto common_of(const A& a, const B& b) {
  if constexpr (std::is_same_v<A, B>) {
    return a;
  } else if constexpr (is_fixed<A> || is_fixed<B>) {
    return fixed_of(a) & fixed_of(b);
  } else if constexpr (is_ap<A> || is_ap<B>) {
    return a & b;
  } else {
    return true ? a : b;
  }
}

template <class T>
constexpr bool is_negative(const T& x) {
  if constexpr (is_fixed<T>) {
    return x.is_neg();
  } else {
    return x < T(0);
  }
}

/// The largest integer whose square is at most v, bit by bit from the highest: no multiplier is needed.
template <int W>
constexpr ap_uint<(W + 1) / 2> integer_root(const ap_uint<W>& v) {
  constexpr int digits = (W + 1) / 2;
  const ap_uint<2 * digits> radicand = v;
  ap_uint<digits + 2> rest = 0;
  ap_uint<digits> root = 0;
  for (int i = digits - 1; i >= 0; --i) {
#ifdef __SYNTHESIS__
#pragma HLS UNROLL
#endif
    rest = (rest << 2) | ap_uint<digits + 2>(ap_uint<2>(radicand >> (2 * i)));
    const ap_uint<digits + 2> trial = (ap_uint<digits + 2>(root) << 2) | ap_uint<1>(1);
    const bool fits = rest >= trial;
    if (fits) rest -= trial;
    root = (root << 1) | ap_uint<1>(fits);
  }
  return root;
}

template <class T>
constexpr T root_of(const T& x) {
  if (is_negative(x)) return T(0);
  if constexpr (is_fixed<T>) {
    // The root of V * 2^-F is that of V * 2^F, times 2^-F.
    constexpr int fraction = T::width - T::iwidth;
    constexpr int moved = fraction < 0 ? -fraction : fraction;
    const ap_uint<T::width + moved> radicand = ap_uint<T::width + moved>(ap_uint<T::width>(x.V)) << moved;
    const auto root = integer_root<T::width + moved>(radicand);
    return T::from_bits(ap_int_base<T::width, T::is_signed>(fraction < 0 ? root >> moved : root));
  } else {
    using integer = value_type<T>;
    return T(integer(integer_root<integer::width>(ap_uint<integer::width>(x))));
  }
}

/// Rounded to an integer by a fixed-point type's own mode.
template <ap_q_mode Q, class T>
constexpr T rounded(const T& x) {
  static_assert(is_fixed<T>, "only ap_fixed and ap_ufixed have something to round");
  if constexpr (is_fixed<T>) {
    constexpr int whole = T::iwidth < 1 ? 2 : T::iwidth + 1;
    return T(ap_fixed_base<whole, whole, T::is_signed, Q>(x));
  } else {
    return x;
  }
}

template <class T>
inline constexpr bool never = false;

}  // namespace epiline::math

namespace hls {

template <class T>
constexpr auto signbit(const T& x) {
  return epiline::math::is_negative(epiline::math::as_number(x));
}
template <class T>
constexpr auto abs(const T& v) {
  const auto x = epiline::math::as_number(v);
  using number = std::decay_t<decltype(x)>;
  return epiline::math::is_negative(x) ? number(-x) : number(x);
}
template <class T>
constexpr auto fabs(const T& v) {
  return abs(v);
}
template <class T, class U>
constexpr auto copysign(const T& v, const U& sign) {
  const auto x = epiline::math::as_number(v);
  using number = std::decay_t<decltype(x)>;
  return signbit(v) == signbit(sign) ? number(x) : number(-x);
}

template <class A, class B>
constexpr auto max(const A& left, const B& right) {
  const auto a = epiline::math::as_number(left);
  const auto b = epiline::math::as_number(right);
  using both = std::decay_t<decltype(epiline::math::common_of(a, b))>;
  return a < b ? both(b) : both(a);
}
template <class A, class B>
constexpr auto min(const A& left, const B& right) {
  const auto a = epiline::math::as_number(left);
  const auto b = epiline::math::as_number(right);
  using both = std::decay_t<decltype(epiline::math::common_of(a, b))>;
  return b < a ? both(b) : both(a);
}
template <class A, class B>
constexpr auto fmax(const A& a, const B& b) {
  return max(a, b);
}
template <class A, class B>
constexpr auto fmin(const A& a, const B& b) {
  return min(a, b);
}

template <class T>
constexpr auto sqrt(const T& x) {
  return epiline::math::root_of(epiline::math::as_number(x));
}

#define EPILINE_HLS_ROUNDING(name, mode)                              \
  template <class T>                                                  \
  constexpr auto name(const T& x) {                                   \
    return epiline::math::rounded<mode>(epiline::math::as_number(x)); \
  }
EPILINE_HLS_ROUNDING(floor, AP_TRN)
EPILINE_HLS_ROUNDING(trunc, AP_TRN_ZERO)
EPILINE_HLS_ROUNDING(round, AP_RND_INF)
EPILINE_HLS_ROUNDING(rint, AP_RND_CONV)
#undef EPILINE_HLS_ROUNDING
template <class T>
constexpr auto ceil(const T& v) {
  const auto x = epiline::math::as_number(v);
  using number = std::decay_t<decltype(x)>;
  const auto whole = floor(x);
  return whole == x ? whole : number(whole + ap_uint<1>(1));
}

#define EPILINE_HLS_REFUSED(name)                                                                                \
  template <class T, class... Rest>                                                                              \
  T name(const T& x, const Rest&...) {                                                                           \
    static_assert(epiline::math::never<T>,                                                                       \
                  "hls::" #name                                                                                  \
                  " is not supported: use a constexpr table, or a series or CORDIC of your own in fixed point"); \
    return x;                                                                                                    \
  }
EPILINE_HLS_REFUSED(sin)
EPILINE_HLS_REFUSED(cos)
EPILINE_HLS_REFUSED(sincos)
EPILINE_HLS_REFUSED(tan)
EPILINE_HLS_REFUSED(asin)
EPILINE_HLS_REFUSED(acos)
EPILINE_HLS_REFUSED(atan)
EPILINE_HLS_REFUSED(atan2)
EPILINE_HLS_REFUSED(sinh)
EPILINE_HLS_REFUSED(cosh)
EPILINE_HLS_REFUSED(tanh)
EPILINE_HLS_REFUSED(sinpi)
EPILINE_HLS_REFUSED(cospi)
EPILINE_HLS_REFUSED(exp)
EPILINE_HLS_REFUSED(exp2)
EPILINE_HLS_REFUSED(exp10)
EPILINE_HLS_REFUSED(expm1)
EPILINE_HLS_REFUSED(log)
EPILINE_HLS_REFUSED(log2)
EPILINE_HLS_REFUSED(log10)
EPILINE_HLS_REFUSED(log1p)
EPILINE_HLS_REFUSED(pow)
EPILINE_HLS_REFUSED(powr)
EPILINE_HLS_REFUSED(pown)
EPILINE_HLS_REFUSED(rootn)
EPILINE_HLS_REFUSED(cbrt)
EPILINE_HLS_REFUSED(hypot)
EPILINE_HLS_REFUSED(rsqrt)
EPILINE_HLS_REFUSED(recip)
EPILINE_HLS_REFUSED(fmod)
EPILINE_HLS_REFUSED(remainder)
EPILINE_HLS_REFUSED(fma)
EPILINE_HLS_REFUSED(ldexp)
EPILINE_HLS_REFUSED(frexp)
EPILINE_HLS_REFUSED(ilogb)
#undef EPILINE_HLS_REFUSED

}  // namespace hls
