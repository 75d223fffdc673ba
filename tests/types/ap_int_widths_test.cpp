// The width and sign of every operator's result, checked by the compiler: the table of the vendors' rules, first as the
// examples known from running their header, then by formula over widths on both sides of every storage boundary.
// Built natively and for synthesis.

#include <ap_int.h>
#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

namespace {

template <class T, int W, bool S>
constexpr bool is = std::is_same_v<T, ap_int_base<W, S>>;

template <class T>
T value();

// The examples.
using s5 = ap_int<5>;
using s8 = ap_int<8>;
using u5 = ap_uint<5>;
using u8 = ap_uint<8>;
static_assert(is<decltype(value<s8>() + value<u8>()), 10, true>);
static_assert(is<decltype(value<s8>() + value<u5>()), 9, true>);
static_assert(is<decltype(value<u8>() + value<u5>()), 9, false>);
static_assert(is<decltype(value<u5>() - value<u8>()), 9, true>);
static_assert(is<decltype(value<s8>() * value<u8>()), 16, true>);
static_assert(is<decltype(value<u8>() * value<u8>()), 16, false>);
static_assert(is<decltype(value<s8>() / value<s5>()), 9, true>);
static_assert(is<decltype(value<u8>() / value<u5>()), 8, false>);
static_assert(is<decltype(value<s8>() % value<u5>()), 6, true>);
static_assert(is<decltype(value<s8>() % value<s5>()), 5, true>);
static_assert(is<decltype(value<s8>() & value<u8>()), 9, true>);
static_assert(is<decltype(~value<u8>()), 8, false>);
static_assert(is<decltype(-value<u8>()), 9, true>);
static_assert(is<decltype(-value<s8>()), 9, true>);
static_assert(is<decltype(+value<u8>()), 8, false>);
static_assert(is<decltype(value<u8>() << value<s5>()), 8, false>);
static_assert(is<decltype(value<s8>() >> value<u5>()), 8, true>);
static_assert(is<decltype(value<u8>() + 1), 33, true>);
static_assert(is<decltype(value<u8>() + 1u), 33, false>);
static_assert(is<decltype(value<s8>() + 1LL), 65, true>);
static_assert(is<decltype(value<u8>() * 2), 40, true>);
static_assert(is<decltype(value<u8>() + true), 9, false>);
static_assert(is<decltype(value<u8>() + static_cast<signed char>(1)), 10, true>);
static_assert(is<decltype(value<u8>() + static_cast<unsigned short>(1)), 17, false>);
static_assert(is<decltype(2 - value<u8>()), 33, true>);
static_assert(is<decltype(value<u8>() << 3), 8, false>);
static_assert(std::is_same_v<decltype(value<u8>() < value<s8>()), bool>);

// What values come out of the examples, at compile time.
static_assert(ap_uint<5>(29) - ap_uint<8>(200) == -171);
static_assert(ap_int<8>(-128) * ap_int<8>(-128) == 16384);
static_assert(ap_int<8>(-128) / ap_int<5>(-1) == 128);
static_assert(~ap_uint<8>(200) == 55);
static_assert(-ap_uint<8>(200) == -200);
static_assert(-ap_int<8>(-128) == 128);
static_assert(ap_int<8>(-1) < ap_uint<8>(1));
static_assert(ap_uint<16>(ap_int<8>(-100)) == 65436);
static_assert(ap_int<8>(ap_uint<8>(200)) == -56);
static_assert(ap_uint<8>(200) / ap_int<5>(-3) == -66);
static_assert(ap_uint<8>(200) % ap_int<5>(-3) == 2);
static_assert((ap_int<8>(-8) >> ap_int<3>(-2)) == -32);
static_assert((ap_uint<8>(1) << 8) == 0);
static_assert((ap_int<8>(-1) >> 100) == -1);

// The formulas.
constexpr int larger(int a, int b) { return a > b ? a : b; }
constexpr int smaller(int a, int b) { return a < b ? a : b; }

template <int W, bool S, int W2, bool S2>
constexpr bool pair_holds() {
  using left = ap_int_base<W, S>;
  using right = ap_int_base<W2, S2>;
  constexpr int left_signed = W + (S2 && !S ? 1 : 0);  // the left value as a number of the common sign
  constexpr int right_signed = W2 + (S && !S2 ? 1 : 0);
  constexpr int both = larger(left_signed, right_signed);
  constexpr bool any = S || S2;
  static_assert(is<decltype(value<left>() + value<right>()), both + 1, any>);
  static_assert(is<decltype(value<left>() - value<right>()), both + 1, true>);
  static_assert(is<decltype(value<left>() * value<right>()), W + W2, any>);
  static_assert(is<decltype(value<left>() / value<right>()), W + (S2 ? 1 : 0), any>);
  static_assert(is<decltype(value<left>() % value<right>()), smaller(W, W2 + (!S2 && S ? 1 : 0)), S>);
  static_assert(is<decltype(value<left>() & value<right>()), both, any>);
  static_assert(is<decltype(value<left>() | value<right>()), both, any>);
  static_assert(is<decltype(value<left>() ^ value<right>()), both, any>);
  static_assert(is<decltype(value<left>() << value<right>()), W, S>);
  static_assert(is<decltype(value<left>() >> value<right>()), W, S>);
  static_assert(is<decltype((value<left>(), value<right>()).get()), W + W2, false>);
  static_assert(is<decltype(value<left>().concat(value<right>()).get()), W + W2, false>);
  static_assert(std::is_same_v<decltype(std::declval<left&>() += value<right>()), left&>);
  return true;
}

template <int W, bool S>
constexpr bool alone_holds() {
  using type = ap_int_base<W, S>;
  static_assert(type::width == W && type::length() == W && type::is_signed == S);
  static_assert(is<decltype(-value<type>()), W + 1, true>);
  static_assert(is<decltype(~value<type>()), W, S>);
  static_assert(is<decltype(std::declval<type&>()++), W, S>);
  static_assert(std::is_same_v<decltype(++std::declval<type&>()), type&>);
  static_assert(std::is_same_v<decltype(!value<type>()), bool>);
  static_assert(is<decltype(std::declval<type&>().range(0, 0).get()), W, false>);
  static_assert(is<decltype(std::declval<type&>()(0, 0) + ap_uint<1>(1)), W + 1, false>);
  static_assert(std::is_trivially_copyable_v<type> && std::is_trivially_default_constructible_v<type>);
  return true;
}

template <int W, int... W2>
constexpr bool row_holds() {
  return alone_holds<W, false>() && alone_holds<W, true>() && (pair_holds<W, false, W2, false>() && ...) &&
         (pair_holds<W, false, W2, true>() && ...) && (pair_holds<W, true, W2, false>() && ...) &&
         (pair_holds<W, true, W2, true>() && ...);
}

template <int... W>
constexpr bool table_holds() {
  return (row_holds<W, W...>() && ...);
}

// The check is the compiler's: reaching this test means that every static_assert above held.
TEST(ap_int_widths, follow_the_table) { EXPECT_TRUE((table_holds<1, 2, 8, 9, 32, 64, 65, 129, 2048>())); }

#ifndef __SYNTHESIS__
// Natively a value takes no more room than the smallest built-in integer that holds it.
static_assert(sizeof(ap_uint<1>) == 1 && sizeof(ap_int<8>) == 1 && sizeof(ap_uint<9>) == 2 && sizeof(ap_int<16>) == 2);
static_assert(sizeof(ap_uint<17>) == 4 && sizeof(ap_int<33>) == 8 && sizeof(ap_uint<65>) == 16);
static_assert(sizeof(ap_uint<129>) == 24 && sizeof(ap_uint<2048>) == 256);
#endif

}  // namespace
