#pragma once
// ap_int<W> and ap_uint<W>: integers of exactly W bits with the vendors' names and meaning. Every operator has the
// exact mathematical result, in a type wide enough to hold it:
//
//   a + b     max(W + (S2 && !S), W2 + (S && !S2)) + 1 bits, signed if either is
//   a - b     the same width, always signed
//   a * b     W + W2 bits, signed if either is
//   a / b     W + S2 bits, signed if either is; truncates toward zero
//   a % b     min(W, W2 + (!S2 && S)) bits, sign of a
//   & | ^     max(W + (S2 && !S), W2 + (S && !S2)) bits, signed if either is
//   -a        W + 1 bits, signed;   ~a   W bits, sign of a
//   << >>     type of a, bits shifted out are lost; >> is arithmetic if a is signed; a negative amount shifts the
//             other way; an amount of W or more leaves 0 (or -1 for >> of a negative value)
//   compares  by value, whatever the signs
//
// (W, S: width and sign of a; W2, S2: of b.) A C integer takes part as an ap_int or ap_uint of its own width, so
// `x + 1` has 33 bits or more. Assignment keeps the low bits, or extends by the sign of the source. x / 0 is all ones
// and x % 0 is x (cut to the result's width); a native run reports it on stderr.
//
// Default construction leaves a value uninitialised, as in hardware; `T{}` and static objects are zero. Debug builds
// fill automatic variables with a pattern (-ftrivial-auto-var-init=pattern, set by the CMake target epiline_hls). A bit
// index or range outside the value stops a native run with a message on stderr.
//
// With __SYNTHESIS__ values are thin over clang's _BitInt; natively over the smallest built-in integer.

// The C library's as well: sources that were written for the vendors' header count on it.
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#ifdef __SYNTHESIS__
#include "detail/integer_synthesis.h"
#else
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "detail/integer_native.h"
#endif

namespace epiline::ap {

template <int W, bool S>
class ap_int_base;
template <class Target>
class ap_range_ref;
template <class Target>
class ap_bit_ref;
template <class High, class Low>
class ap_concat_ref;

namespace detail {

// C integers: built-in integers and enumerations that convert to them implicitly.
template <class T>
inline constexpr bool is_c_integer =
    std::is_integral_v<T> || (std::is_enum_v<T> && std::is_convertible_v<T, long long>);

template <class T>
constexpr auto promote(T v) {
  if constexpr (std::is_enum_v<T>) {
    return +v;
  } else {
    return v;
  }
}
template <class T>
using c_integer = decltype(promote(std::declval<T>()));
template <class T>
inline constexpr int width_of_c = std::is_same_v<c_integer<T>, bool> ? 1 : static_cast<int>(8 * sizeof(c_integer<T>));
template <class T>
inline constexpr bool sign_of_c = std::is_signed_v<c_integer<T>>;

// is_ap: an ap_int_base (or a class derived from one) or a proxy of one.
template <int W, bool S>
std::true_type probe(const ap_int_base<W, S>*);
template <class Target>
std::true_type probe(const ap_range_ref<Target>*);
template <class Target>
std::true_type probe(const ap_bit_ref<Target>*);
template <class High, class Low>
std::true_type probe(const ap_concat_ref<High, Low>*);
std::false_type probe(const void*);

template <int W, bool S>
std::false_type probe_proxy(const ap_int_base<W, S>*);
std::true_type probe_proxy(const void*);

template <class T, bool = std::is_class_v<T>>
struct ap_trait : std::false_type {};
template <class T>
struct ap_trait<T, true> : decltype(probe(static_cast<const T*>(nullptr))){};
template <class T>
inline constexpr bool is_ap = ap_trait<T>::value;
// of an is_ap type
template <class T>
inline constexpr bool is_proxy = decltype(probe_proxy(static_cast<const T*>(nullptr)))::value;

template <class T>
inline constexpr bool is_operand = is_ap<T> || is_c_integer<T>;
template <class A, class B>
inline constexpr bool are_operands = (is_ap<A> && is_operand<B>) || (is_c_integer<A> && is_ap<B>);
// Which of two operands are classes: the others are built in.
template <bool condition, class A, class B>
using if_both_classes = std::enable_if_t<condition && std::is_class_v<A> && std::is_class_v<B>, int>;
template <bool condition, class A, class B>
using if_left_class = std::enable_if_t<condition && !std::is_class_v<B>, int>;
template <bool condition, class A, class B>
using if_right_class = std::enable_if_t<condition && !std::is_class_v<A>, int>;
// A: what a forwarding reference deduces for the left side of a compound assignment. Proxies may be temporaries.
template <class A, class B, class Bare = std::decay_t<A>>
using if_assignable = std::enable_if_t<is_ap<Bare> && is_operand<B> && !std::is_const_v<std::remove_reference_t<A>> &&
                                           (std::is_lvalue_reference_v<A> || is_proxy<Bare>),
                                       std::remove_reference_t<A>&>;

constexpr int larger(int a, int b) { return a > b ? a : b; }
constexpr int smaller(int a, int b) { return a < b ? a : b; }

}  // namespace detail

namespace detail {

// Above 64 bits the implicit conversion to a C integer does not hold the value, so bool needs a conversion of its own;
// a template, because it must never compete with the other one for any other target type.
template <class Derived, bool wide>
struct bool_conversion {};
template <class Derived>
struct bool_conversion<Derived, true> {
  template <class T, std::enable_if_t<std::is_same_v<T, bool>, int> = 0>
  constexpr operator T() const {
    return static_cast<const Derived&>(*this).to_bool();
  }
};

}  // namespace detail

/// The integer itself; ap_int<W> is ap_int_base<W, true>, ap_uint<W> is ap_int_base<W, false>.
template <int W, bool S>
class ap_int_base : public detail::bool_conversion<ap_int_base<W, S>, (W > 64)> {
  static_assert(W >= 1, "an ap_int or ap_uint has at least one bit");

 public:
  static constexpr int width = W;
  static constexpr bool is_signed = S;
  using raw = backend::raw<W, S>;
  /// What the value converts to implicitly: a C integer that holds it, or its low 64 bits.
  using c_type = std::conditional_t<(W <= 32), std::conditional_t<S, int, unsigned>,
                                    std::conditional_t<S, long long, unsigned long long>>;

  /// Result types of operators with an ap_int_base<W2, S2> on the right.
  template <int W2, bool S2>
  struct RType {
    static constexpr int logic_w = detail::larger(W + (S2 && !S), W2 + (S && !S2));
    using plus = ap_int_base<logic_w + 1, S || S2>;
    using minus = ap_int_base<logic_w + 1, true>;
    using mult = ap_int_base<W + W2, S || S2>;
    using div = ap_int_base<W + S2, S || S2>;
    using mod = ap_int_base<detail::smaller(W, W2 + (!S2 && S)), S>;
    using logic = ap_int_base<logic_w, S || S2>;
    using arg1 = ap_int_base;
    /// Holds every value of both operands and of their quotient.
    using common = ap_int_base<detail::larger(W + S2, W2 + (S && !S2)), S || S2>;
  };

  ap_int_base() = default;

  template <int W2, bool S2>
  constexpr ap_int_base(const ap_int_base<W2, S2>& v) : stored_(converted(v)) {}
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_int_base(T v) : stored_(from_c(detail::promote(v))) {}
  template <class Target>
  constexpr ap_int_base(const ap_range_ref<Target>& v) : ap_int_base(v.template get_low<W>()) {}
  template <class Target>
  constexpr ap_int_base(const ap_bit_ref<Target>& v) : ap_int_base(v.to_bool()) {}
  template <class High, class Low>
  constexpr ap_int_base(const ap_concat_ref<High, Low>& v) : ap_int_base(v.get()) {}

  /// From the back end's representation, which must hold a value of W bits.
  static constexpr ap_int_base from_raw(const raw& v) {
    ap_int_base r(v, from_raw_tag{});
    return r;
  }
  constexpr raw to_raw() const { return stored_.load(); }

  // Of constants, in hardware: text and floating point.

  /// Truncates toward zero, then keeps the low W bits. Throws std::invalid_argument for NaN and infinities.
  template <class T, std::enable_if_t<std::is_floating_point_v<T>, int> = 0>
  ap_int_base(T v) : ap_int_base(from_floating(v)) {}

  /// Reads "[+-][0x|0o|0b]digits"; radix 2, 8, 10 or 16, or 0 to take it from the prefix (none: decimal). The value is
  /// kept modulo 2^W. Throws std::invalid_argument if there is no digit or a character that is none.
  ap_int_base(const char* text, int radix = 0) : ap_int_base(from_string(text, radix)) {}
#ifndef __SYNTHESIS__
  explicit ap_int_base(const std::string& text, int radix = 0) : ap_int_base(text.c_str(), radix) {}
#endif

  // Conversions to C types keep the low bits; bool is "not zero".
  constexpr operator c_type() const { return backend::to_c<c_type>(to_raw()); }
  constexpr bool to_bool() const { return to_raw() != raw(0); }
  constexpr char to_char() const { return backend::to_c<char>(to_raw()); }
  constexpr signed char to_schar() const { return backend::to_c<signed char>(to_raw()); }
  constexpr unsigned char to_uchar() const { return backend::to_c<unsigned char>(to_raw()); }
  constexpr short to_short() const { return backend::to_c<short>(to_raw()); }
  constexpr unsigned short to_ushort() const { return backend::to_c<unsigned short>(to_raw()); }
  constexpr int to_int() const { return backend::to_c<int>(to_raw()); }
  constexpr unsigned to_uint() const { return backend::to_c<unsigned>(to_raw()); }
  constexpr long to_long() const { return backend::to_c<long>(to_raw()); }
  constexpr unsigned long to_ulong() const { return backend::to_c<unsigned long>(to_raw()); }
  constexpr long long to_int64() const { return backend::to_c<long long>(to_raw()); }
  constexpr unsigned long long to_uint64() const { return backend::to_c<unsigned long long>(to_raw()); }

  static constexpr int length() { return W; }
  /// Whether the value is negative.
  constexpr bool sign() const { return S && to_raw() < raw(0); }
  constexpr bool is_zero() const { return !to_bool(); }
  constexpr bool iszero() const { return !to_bool(); }

  // Bits and ranges. Bit 0 is the lowest.
  constexpr ap_bit_ref<ap_int_base> operator[](int index) { return ap_bit_ref<ap_int_base>(*this, index); }
  constexpr ap_bit_ref<const ap_int_base> operator[](int index) const {
    return ap_bit_ref<const ap_int_base>(*this, index);
  }
  constexpr ap_bit_ref<ap_int_base> bit(int index) { return (*this)[index]; }
  constexpr ap_bit_ref<const ap_int_base> bit(int index) const { return (*this)[index]; }
  /// Bits low..high as an unsigned pattern; with high < low the bits high..low in reverse order.
  constexpr ap_range_ref<ap_int_base> range(int high, int low) { return ap_range_ref<ap_int_base>(*this, high, low); }
  constexpr ap_range_ref<const ap_int_base> range(int high, int low) const {
    return ap_range_ref<const ap_int_base>(*this, high, low);
  }
  constexpr ap_range_ref<ap_int_base> range() { return range(W - 1, 0); }
  constexpr ap_range_ref<const ap_int_base> range() const { return range(W - 1, 0); }
  constexpr ap_range_ref<ap_int_base> operator()(int high, int low) { return range(high, low); }
  constexpr ap_range_ref<const ap_int_base> operator()(int high, int low) const { return range(high, low); }

  constexpr bool test(int index) const {
    backend::check_bit_index(index, W);
    return backend::test_bit<W, S>(to_raw(), index);
  }
  constexpr bool get_bit(int index) const { return test(index); }
  constexpr void set(int index, bool value) {
    backend::check_bit_index(index, W);
    bits_type one = backend::wrap<W, false>(bits_type(1) << index);
    bits_type kept = backend::wrap<W, false>(bits() & backend::wrap<W, false>(~one));
    set_bits(backend::wrap<W, false>(kept | backend::wrap<W, false>(bits_type(value) << index)));
  }
  constexpr void set_bit(int index, bool value) { set(index, value); }
  constexpr void set(int index) { set(index, true); }
  constexpr void clear(int index) { set(index, false); }
  constexpr void invert(int index) { set(index, !test(index)); }
  /// Complements every bit.
  constexpr void b_not() { *this = ~*this; }
  /// Puts the bits into reverse order.
  constexpr ap_int_base& reverse() {
    set_bits(backend::reverse_bits<W>(bits()));
    return *this;
  }
  /// Rotates by 0 <= n < W places.
  constexpr ap_int_base& lrotate(int n) {
    backend::check_bit_index(n, W);
    bits_type u = bits();
    if (n != 0) {
      set_bits(backend::wrap<W, false>(backend::wrap<W, false>(u << n) | backend::wrap<W, false>(u >> (W - n))));
    }
    return *this;
  }
  constexpr ap_int_base& rrotate(int n) {
    backend::check_bit_index(n, W);
    return lrotate(n == 0 ? 0 : W - n);
  }

  constexpr bool and_reduce() const { return bits() == all_ones(); }
  constexpr bool nand_reduce() const { return !and_reduce(); }
  constexpr bool or_reduce() const { return to_bool(); }
  constexpr bool nor_reduce() const { return !to_bool(); }
  constexpr bool xor_reduce() const { return folded_parity<1>(bits()); }
  constexpr bool xnor_reduce() const { return !xor_reduce(); }
  /// Number of zeros above the highest one; W for zero.
  constexpr int countLeadingZeros() const {
    if constexpr (W == 1) {
      return to_bool() ? 0 : 1;
    } else {
      // A balanced tree: the upper half decides unless it is zero.
      constexpr int lower = W / 2;
      const ap_int_base<W - lower, false> top(ap_int_base<W, false>(*this) >> lower);
      const ap_int_base<lower, false> bottom(*this);
      return top.to_bool() ? top.countLeadingZeros() : W - lower + bottom.countLeadingZeros();
    }
  }

  /// This value on top of `low`: W plus its width bits; assignable if both are.
  template <class Low>
  constexpr auto concat(Low&& low) {
    return (*this, std::forward<Low>(low));
  }
  template <class Low>
  constexpr auto concat(Low&& low) const {
    return (*this, std::forward<Low>(low));
  }
  constexpr ap_int_base get() const { return *this; }

  constexpr bool operator!() const { return !to_bool(); }
  constexpr ap_int_base operator+() const { return *this; }
  constexpr ap_int_base<W + 1, true> operator-() const {
    return ap_int_base<W + 1, true>::from_raw(backend::convert<W + 1, true>(-backend::convert<W + 1, true>(to_raw())));
  }
  constexpr ap_int_base operator~() const { return from_raw(backend::wrap<W, S>(~to_raw())); }

  constexpr ap_int_base& operator++() { return *this = *this + one_bit(1); }
  constexpr ap_int_base& operator--() { return *this = *this - one_bit(1); }
  constexpr ap_int_base operator++(int) {
    const ap_int_base old = *this;
    ++*this;
    return old;
  }
  constexpr ap_int_base operator--(int) {
    const ap_int_base old = *this;
    --*this;
    return old;
  }

#ifndef __SYNTHESIS__
  /// Digits in radix 2, 8, 10 or 16 (std::invalid_argument otherwise), with the prefix 0b, 0o or 0x unless decimal.
  /// With `sign` a negative value is "-" and its magnitude; otherwise the W-bit pattern is written as unsigned. Radix 2
  /// always shows the pattern.
  std::string to_string(int radix = 2, bool sign = S) const;
#endif
  /// Of constants, in hardware.
  double to_double() const;
  float to_float() const { return static_cast<float>(to_double()); }

 private:
  template <int, bool>
  friend class ap_int_base;
  template <class>
  friend class ap_range_ref;

  struct from_raw_tag {};
  using bits_type = backend::raw<W, false>;

  // Depends on W: clang would otherwise instantiate ap_int_base<1, false> before this template's own members are
  // parsed, and then not know them in constant expressions.
  using one_bit = ap_int_base<W / W, false>;

  constexpr ap_int_base(const raw& v, from_raw_tag) : stored_(v) {}

  template <int W2, bool S2>
  static constexpr raw converted(const ap_int_base<W2, S2>& v) {
    if constexpr (S == S2 ? W2 <= W : S && W2 < W) {
      return backend::convert<W, S>(v.to_raw());
    } else {
      return backend::wrap<W, S>(v.to_raw());
    }
  }
  template <class T>
  static constexpr raw from_c(T v) {
    return backend::wrap<W, S>(v);
  }

  // The W bits as an unsigned number.
  constexpr bits_type bits() const { return backend::wrap<W, false>(to_raw()); }
  constexpr void set_bits(const bits_type& v) { *this = from_raw(backend::wrap<W, S>(v)); }
  static constexpr bits_type all_ones() { return backend::wrap<W, false>(~bits_type(0)); }
  // The exclusive or of v's bits 0, distance, 2 distance, ... is not changed by folding: no loop, for the hardware's
  // sake.
  template <int distance>
  static constexpr bool folded_parity(const bits_type& v) {
    if constexpr (distance < W) {
      return folded_parity<2 * distance>(backend::wrap<W, false>(v ^ backend::wrap<W, false>(v >> distance)));
    } else {
      return backend::test_bit<W, false>(v, 0);
    }
  }

  template <class T>
  static ap_int_base from_floating(T v);
  static ap_int_base from_string(const char* text, int radix);

  backend::storage<W, S> stored_;
};

namespace detail {

// The value an operand stands for, as an ap_int_base.
template <int W, bool S>
constexpr const ap_int_base<W, S>& value_of(const ap_int_base<W, S>& v) {
  return v;
}
template <class Target>
constexpr auto value_of(const ap_range_ref<Target>& v) {
  return v.get();
}
template <class Target>
constexpr ap_int_base<1, false> value_of(const ap_bit_ref<Target>& v) {
  return ap_int_base<1, false>(v.to_bool());
}
template <class High, class Low>
constexpr auto value_of(const ap_concat_ref<High, Low>& v) {
  return v.get();
}
template <class T, std::enable_if_t<is_c_integer<T>, int> = 0>
constexpr ap_int_base<width_of_c<T>, sign_of_c<T>> value_of(T v) {
  return ap_int_base<width_of_c<T>, sign_of_c<T>>(v);
}
template <class T>
using value_type = std::decay_t<decltype(value_of(std::declval<const T&>()))>;

}  // namespace detail

/// Bits low..high of an integer, reversed if high < low: reads as an unsigned pattern, writing keeps the source's low
/// bits.
template <class Target>
class ap_range_ref {
 public:
  static constexpr int width = Target::width;
  using value = ap_int_base<width, false>;

  constexpr ap_range_ref(Target& target, int high, int low) : target_(&target), high_(high), low_(low) {
    backend::check_range(high, low, width);
  }
  ap_range_ref(const ap_range_ref&) = default;

  constexpr value get() const {
    bits field = backend::wrap<width, false>(target_->bits() >> lowest()) & mask();
    return value::from_raw(backend::wrap<width, false>(ordered(backend::wrap<width, false>(field))));
  }
  /// get() modulo 2^W, as far as that is cheaper to compute.
  template <int W>
  constexpr auto get_low() const {
    if constexpr (W <= 64 && width > 64) {
      using word = ap_int_base<64, false>;
      if (high_ < low_) return word(get());
      auto field = backend::word_at<width>(target_->to_raw(), low_);
      if (length() < 64) field = (field << (64 - length())) >> (64 - length());
      return word::from_raw(field);
    } else {
      return get();
    }
  }
  constexpr operator unsigned long long() const { return get().to_uint64(); }
  constexpr int length() const { return (high_ >= low_ ? high_ - low_ : low_ - high_) + 1; }

  template <class T, std::enable_if_t<detail::is_ap<T>, int> = 0>
  constexpr ap_range_ref& operator=(const T& v) {
    write(value(detail::value_of(v)));
    return *this;
  }
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_range_ref& operator=(T v) {
    write(value(detail::value_of(v)));
    return *this;
  }
  constexpr ap_range_ref& operator=(const ap_range_ref& v) {
    write(v.get());
    return *this;
  }
  constexpr void set(const value& v) { write(v); }

  constexpr bool to_bool() const { return get().to_bool(); }
  constexpr char to_char() const { return get().to_char(); }
  constexpr int to_int() const { return get().to_int(); }
  constexpr unsigned to_uint() const { return get().to_uint(); }
  constexpr long to_long() const { return get().to_long(); }
  constexpr unsigned long to_ulong() const { return get().to_ulong(); }
  constexpr long long to_int64() const { return get().to_int64(); }
  constexpr unsigned long long to_uint64() const { return get().to_uint64(); }
  constexpr bool and_reduce() const { return get() == value::from_raw(mask()); }
  constexpr bool nand_reduce() const { return !and_reduce(); }
  constexpr bool or_reduce() const { return get().or_reduce(); }
  constexpr bool nor_reduce() const { return !or_reduce(); }
  constexpr bool xor_reduce() const { return get().xor_reduce(); }
  constexpr bool xnor_reduce() const { return !xor_reduce(); }
#ifndef __SYNTHESIS__
  std::string to_string(int radix = 2) const { return get().to_string(radix); }
#endif

 private:
  using bits = backend::raw<width, false>;

  constexpr int lowest() const { return high_ >= low_ ? low_ : high_; }
  // length() ones
  constexpr bits mask() const { return backend::wrap<width, false>(value::all_ones() >> (width - length())); }
  // `field`, turned round within its length() bits if the range is written low to high
  constexpr bits ordered(const bits& field) const {
    if (high_ >= low_) return field;
    return backend::wrap<width, false>(backend::reverse_bits<width>(field) >> (width - length()));
  }
  constexpr void write(const value& v) {
    bits field = ordered(backend::wrap<width, false>(v.to_raw() & mask()));
    bits hole = backend::wrap<width, false>(~backend::wrap<width, false>(mask() << lowest()));
    target_->set_bits(backend::wrap<width, false>(backend::wrap<width, false>(target_->bits() & hole) |
                                                  backend::wrap<width, false>(field << lowest())));
  }

  Target* target_;
  int high_;
  int low_;
};

/// One bit of an integer; assigning stores whether the source is not zero.
template <class Target>
class ap_bit_ref {
 public:
  static constexpr int width = 1;

  constexpr ap_bit_ref(Target& target, int index) : target_(&target), index_(index) {
    backend::check_bit_index(index, Target::width);
  }
  ap_bit_ref(const ap_bit_ref&) = default;

  constexpr operator bool() const { return to_bool(); }
  constexpr bool to_bool() const { return static_cast<const Target&>(*target_).test(index_); }
  constexpr bool get() const { return to_bool(); }
  constexpr bool operator~() const { return !to_bool(); }
  static constexpr int length() { return 1; }

  template <class T, std::enable_if_t<detail::is_ap<T>, int> = 0>
  constexpr ap_bit_ref& operator=(const T& v) {
    target_->set(index_, detail::value_of(v).to_bool());
    return *this;
  }
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_bit_ref& operator=(T v) {
    target_->set(index_, detail::value_of(v).to_bool());
    return *this;
  }
  constexpr ap_bit_ref& operator=(const ap_bit_ref& v) {
    target_->set(index_, v.to_bool());
    return *this;
  }
#ifndef __SYNTHESIS__
  std::string to_string() const { return to_bool() ? "1" : "0"; }
#endif

 private:
  Target* target_;
  int index_;
};

/// (high, low): the bits of `high` on top of those of `low`. `High` and `Low` are references to integers, or proxies
/// and temporaries by value. Reads as unsigned; assigning distributes the source's bits from the lowest up.
template <class High, class Low>
class ap_concat_ref {
  using high_value = detail::value_type<std::decay_t<High>>;
  using low_value = detail::value_type<std::decay_t<Low>>;

 public:
  static constexpr int width = high_value::width + low_value::width;
  using value = ap_int_base<width, false>;

  constexpr ap_concat_ref(High high, Low low) : high_(static_cast<High>(high)), low_(static_cast<Low>(low)) {}
  ap_concat_ref(const ap_concat_ref&) = default;

  constexpr value get() const { return (value(as_bits(high_)) << low_.length()) | value(as_bits(low_)); }
  constexpr operator unsigned long long() const { return get().to_uint64(); }
  constexpr int length() const { return high_.length() + low_.length(); }

  template <class T, std::enable_if_t<detail::is_ap<T>, int> = 0>
  constexpr ap_concat_ref& operator=(const T& v) {
    write(value(detail::value_of(v)));
    return *this;
  }
  template <class T, std::enable_if_t<detail::is_c_integer<T>, int> = 0>
  constexpr ap_concat_ref& operator=(T v) {
    write(value(detail::value_of(v)));
    return *this;
  }
  constexpr ap_concat_ref& operator=(const ap_concat_ref& v) {
    write(v.get());
    return *this;
  }
  constexpr void set(const value& v) { write(v); }

  constexpr bool to_bool() const { return get().to_bool(); }
  constexpr int to_int() const { return get().to_int(); }
  constexpr unsigned to_uint() const { return get().to_uint(); }
  constexpr long to_long() const { return get().to_long(); }
  constexpr unsigned long to_ulong() const { return get().to_ulong(); }
  constexpr long long to_int64() const { return get().to_int64(); }
  constexpr unsigned long long to_uint64() const { return get().to_uint64(); }
#ifndef __SYNTHESIS__
  std::string to_string(int radix = 2) const { return get().to_string(radix); }
#endif

 private:
  template <class Part>
  static constexpr auto as_bits(const Part& part) {
    const auto v = detail::value_of(part);
    return ap_int_base<decltype(v)::width, false>(v);
  }
  constexpr void write(const value& v) {
    low_ = ap_int_base<low_value::width, false>(v);
    high_ = ap_int_base<high_value::width, false>(v >> low_.length());
  }

  High high_;
  Low low_;
};

namespace detail {

// What a concatenation keeps of an operand: a reference to a named integer, everything else by value.
template <class T, class Bare = std::decay_t<T>>
using concat_part = std::conditional_t<
    is_c_integer<Bare>, value_type<Bare>,
    std::conditional_t<is_proxy<Bare>, Bare,
                       std::conditional_t<!std::is_lvalue_reference_v<T>, value_type<Bare>,
                                          std::conditional_t<std::is_const_v<std::remove_reference_t<T>>,
                                                             const value_type<Bare>&, value_type<Bare>&>>>>;

}  // namespace detail

// Built-in operands come by value, here and below: a reference to a class's `static const int shift = 4;` would want a
// definition of it, which nobody writes. Integers of this header come by reference: by value they would travel in an
// ABI's containers.
#define EPILINE_AP_CONCATENATION(which, LEFT, RIGHT)                                                                  \
  template <class A, class B,                                                                                         \
            detail::which<detail::are_operands<std::decay_t<A>, std::decay_t<B>>, std::decay_t<A>, std::decay_t<B>> = \
                0>                                                                                                    \
  constexpr auto operator,(LEFT high, RIGHT low) {                                                                    \
    using high_part = detail::concat_part<A>;                                                                         \
    using low_part = detail::concat_part<B>;                                                                          \
    return ap_concat_ref<high_part, low_part>(static_cast<high_part>(high), static_cast<low_part>(low));              \
  }
EPILINE_AP_CONCATENATION(if_both_classes, A&&, B&&)
EPILINE_AP_CONCATENATION(if_left_class, A&&, B)
EPILINE_AP_CONCATENATION(if_right_class, A, B&&)
#undef EPILINE_AP_CONCATENATION

// The operators proper, on values.
namespace detail {

template <class Result, int W, bool S>
constexpr typename Result::raw in(const ap_int_base<W, S>& v) {
  return backend::convert<Result::width, Result::is_signed>(v.to_raw());
}
template <class Result, class Raw>
constexpr Result exact(const Raw& v) {
  return Result::from_raw(backend::convert<Result::width, Result::is_signed>(v));
}
template <class A, class B>
using rules = typename A::template RType<B::width, B::is_signed>;

template <class A, class B>
constexpr auto add(const A& a, const B& b) {
  using result = typename rules<A, B>::plus;
  return exact<result>(in<result>(a) + in<result>(b));
}
template <class A, class B>
constexpr auto subtract(const A& a, const B& b) {
  using result = typename rules<A, B>::minus;
  return exact<result>(in<result>(a) - in<result>(b));
}
template <class A, class B>
constexpr auto multiply(const A& a, const B& b) {
  using result = typename rules<A, B>::mult;
  return exact<result>(in<result>(a) * in<result>(b));
}
template <class A, class B>
constexpr auto divide(const A& a, const B& b) {
  using result = typename rules<A, B>::div;
  using common = typename rules<A, B>::common;
  if (b.is_zero()) {
    backend::report_division_by_zero(A::width, A::is_signed, B::width, B::is_signed);
    return result(ap_int_base<2, true>(-1));
  }
  return exact<result>(in<common>(a) / in<common>(b));
}
template <class A, class B>
constexpr auto remainder(const A& a, const B& b) {
  using result = typename rules<A, B>::mod;
  using common = typename rules<A, B>::common;
  if (b.is_zero()) {
    backend::report_division_by_zero(A::width, A::is_signed, B::width, B::is_signed);
    return result(a);
  }
  return exact<result>(in<common>(a) % in<common>(b));
}
template <class A, class B>
constexpr auto bit_and(const A& a, const B& b) {
  using result = typename rules<A, B>::logic;
  return exact<result>(in<result>(a) & in<result>(b));
}
template <class A, class B>
constexpr auto bit_or(const A& a, const B& b) {
  using result = typename rules<A, B>::logic;
  return exact<result>(in<result>(a) | in<result>(b));
}
template <class A, class B>
constexpr auto bit_xor(const A& a, const B& b) {
  using result = typename rules<A, B>::logic;
  return exact<result>(in<result>(a) ^ in<result>(b));
}

// Shifts by an amount that is not negative.
template <int W, bool S, int W2>
constexpr ap_int_base<W, S> left_by(const ap_int_base<W, S>& a, const ap_int_base<W2, false>& amount) {
  if (amount >= ap_int_base<32, false>(W)) return ap_int_base<W, S>(false);
  return ap_int_base<W, S>::from_raw(backend::wrap<W, S>(backend::wrap<W, false>(a.to_raw()) << amount.to_int()));
}
template <int W, bool S, int W2>
constexpr ap_int_base<W, S> right_by(const ap_int_base<W, S>& a, const ap_int_base<W2, false>& amount) {
  if (amount >= ap_int_base<32, false>(W)) return a.sign() ? ~ap_int_base<W, S>(false) : ap_int_base<W, S>(false);
  return exact<ap_int_base<W, S>>(a.to_raw() >> amount.to_int());
}
template <int W, bool S, int W2, bool S2>
constexpr ap_int_base<W, S> shift_left(const ap_int_base<W, S>& a, const ap_int_base<W2, S2>& amount) {
  if constexpr (S2) {
    if (amount.sign()) return right_by(a, ap_int_base<W2, false>(-amount));
  }
  return left_by(a, ap_int_base<W2, false>(amount));
}
template <int W, bool S, int W2, bool S2>
constexpr ap_int_base<W, S> shift_right(const ap_int_base<W, S>& a, const ap_int_base<W2, S2>& amount) {
  if constexpr (S2) {
    if (amount.sign()) return left_by(a, ap_int_base<W2, false>(-amount));
  }
  return right_by(a, ap_int_base<W2, false>(amount));
}

// The left side of a shift as C promotes it, and the shifted value as what C makes of it.
template <class A>
constexpr decltype(auto) promoted(const A& a) {
  if constexpr (is_ap<A>) {
    return (a);
  } else {
    return +a;
  }
}
template <class A, class Value>
constexpr auto shifted(const Value& v) {
  if constexpr (is_ap<A>) {
    return v;
  } else {
    return static_cast<decltype(+std::declval<A>())>(v);
  }
}

// Both values in a type that holds either, so that compares are mathematical across signs.
template <class A, class B>
constexpr bool equal(const A& a, const B& b) {
  using common = typename rules<A, B>::logic;
  return in<common>(a) == in<common>(b);
}
template <class A, class B>
constexpr bool less(const A& a, const B& b) {
  using common = typename rules<A, B>::logic;
  return in<common>(a) < in<common>(b);
}

}  // namespace detail

#define EPILINE_AP_OPERATOR(condition, symbol, ...)                               \
  template <class A, class B, detail::if_both_classes<condition<A, B>, A, B> = 0> \
  constexpr auto operator symbol(const A& a, const B& b) {                        \
    return __VA_ARGS__;                                                           \
  }                                                                               \
  template <class A, class B, detail::if_left_class<condition<A, B>, A, B> = 0>   \
  constexpr auto operator symbol(const A& a, B b) {                               \
    return __VA_ARGS__;                                                           \
  }                                                                               \
  template <class A, class B, detail::if_right_class<condition<A, B>, A, B> = 0>  \
  constexpr auto operator symbol(A a, const B& b) {                               \
    return __VA_ARGS__;                                                           \
  }
#define EPILINE_AP_ASSIGNMENT(symbol, ...)                                     \
  template <class A, class B, std::enable_if_t<std::is_class_v<B>, int> = 0>   \
  constexpr detail::if_assignable<A, B> operator symbol(A && a, const B & b) { \
    return a = __VA_ARGS__;                                                    \
  }                                                                            \
  template <class A, class B, std::enable_if_t<!std::is_class_v<B>, int> = 0>  \
  constexpr detail::if_assignable<A, B> operator symbol(A && a, B b) {         \
    return a = __VA_ARGS__;                                                    \
  }

#define EPILINE_AP_BINARY(symbol, compound, function)                                                           \
  EPILINE_AP_OPERATOR(detail::are_operands, symbol, detail::function(detail::value_of(a), detail::value_of(b))) \
  EPILINE_AP_ASSIGNMENT(compound, detail::function(detail::value_of(a), detail::value_of(b)))
EPILINE_AP_BINARY(+, +=, add)
EPILINE_AP_BINARY(-, -=, subtract)
EPILINE_AP_BINARY(*, *=, multiply)
EPILINE_AP_BINARY(/, /=, divide)
EPILINE_AP_BINARY(%, %=, remainder)
EPILINE_AP_BINARY(&, &=, bit_and)
EPILINE_AP_BINARY(|, |=, bit_or)
EPILINE_AP_BINARY(^, ^=, bit_xor)
#undef EPILINE_AP_BINARY

// A C integer shifted by an ap amount stays the C integer that C would make of it.
#define EPILINE_AP_SHIFT(symbol, compound, function)                                                    \
  EPILINE_AP_OPERATOR(                                                                                  \
      detail::are_operands, symbol,                                                                     \
      detail::shifted<A>(detail::function(detail::value_of(detail::promoted(a)), detail::value_of(b)))) \
  EPILINE_AP_ASSIGNMENT(compound, detail::function(detail::value_of(a), detail::value_of(b)))
EPILINE_AP_SHIFT(<<, <<=, shift_left)
EPILINE_AP_SHIFT(>>, >>=, shift_right)
#undef EPILINE_AP_SHIFT

EPILINE_AP_OPERATOR(detail::are_operands, ==, detail::equal(detail::value_of(a), detail::value_of(b)))
EPILINE_AP_OPERATOR(detail::are_operands, !=, !detail::equal(detail::value_of(a), detail::value_of(b)))
EPILINE_AP_OPERATOR(detail::are_operands, <, detail::less(detail::value_of(a), detail::value_of(b)))
EPILINE_AP_OPERATOR(detail::are_operands, >, detail::less(detail::value_of(b), detail::value_of(a)))
EPILINE_AP_OPERATOR(detail::are_operands, <=, !detail::less(detail::value_of(b), detail::value_of(a)))
EPILINE_AP_OPERATOR(detail::are_operands, >=, !detail::less(detail::value_of(a), detail::value_of(b)))
#undef EPILINE_AP_ASSIGNMENT  // EPILINE_AP_OPERATOR serves ap_fixed.h, too

}  // namespace epiline::ap

#include "detail/conversions.h"
#ifndef __SYNTHESIS__
#include "detail/text_native.h"
#endif

template <int W>
using ap_int = epiline::ap::ap_int_base<W, true>;
template <int W>
using ap_uint = epiline::ap::ap_int_base<W, false>;
using epiline::ap::ap_bit_ref;
using epiline::ap::ap_concat_ref;
using epiline::ap::ap_int_base;
using epiline::ap::ap_range_ref;

namespace std {
template <int W, bool S>
class numeric_limits<epiline::ap::ap_int_base<W, S>> {
  using value = epiline::ap::ap_int_base<W, S>;

 public:
  static constexpr bool is_specialized = true;
  static constexpr bool is_signed = S;
  static constexpr bool is_integer = true;
  static constexpr bool is_exact = true;
  static constexpr bool is_bounded = true;
  static constexpr bool is_modulo = true;
  static constexpr int radix = 2;
  static constexpr int digits = W - S;
  static constexpr value max() { return ~min(); }
  static constexpr value min() {
    value v(false);
    if constexpr (S) v.set(W - 1);
    return v;
  }
  static constexpr value lowest() { return min(); }
};
}  // namespace std
