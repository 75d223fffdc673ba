// ap_fixed against an independent computation in floating point, which holds all values of these widths exactly.

#include <ap_fixed.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace {

double rounded(double v, ap_q_mode mode) {
  const double below = std::floor(v);
  const double rest = v - below;
  switch (mode) {
    case AP_TRN:
      return below;
    case AP_TRN_ZERO:
      return std::trunc(v);
    case AP_RND:
      return std::floor(v + 0.5);
    case AP_RND_MIN_INF:
      return std::ceil(v - 0.5);
    case AP_RND_INF:
      return std::round(v);
    case AP_RND_ZERO:
      return v < 0 ? std::floor(v + 0.5) : std::ceil(v - 0.5);
    case AP_RND_CONV:
      if (rest != 0.5) return std::round(v);
      return std::fmod(below, 2) == 0 ? below : below + 1;
  }
  return 0;
}

double limited(double v, int width, bool is_signed, ap_o_mode mode) {
  const double range = std::ldexp(1, width);
  const double most = is_signed ? range / 2 - 1 : range - 1;
  const double least = is_signed ? -range / 2 : 0;
  if (mode == AP_WRAP) {
    v = std::fmod(v, range);
    if (v < least) v += range;
    return v > most ? v - range : v;
  }
  if (v > most) return mode == AP_SAT_ZERO ? 0 : most;
  const double symmetric = mode == AP_SAT_SYM && is_signed ? -most : least;
  if (v < symmetric) return mode == AP_SAT_ZERO ? 0 : symmetric;
  return v;
}

template <class Target>
double fitted(double v) {
  const double integer = rounded(std::ldexp(v, Target::fraction), Target::qmode);
  return std::ldexp(limited(integer, Target::width, Target::is_signed, Target::omode), -Target::fraction);
}

template <class T>
T of_pattern(int pattern) {
  return T::from_bits(pattern);
}

/// Every value of Source goes into Target, from the number and from the floating point constant.
template <class Source, class Target>
void check_conversion() {
  for (int pattern = 0; pattern < 1 << Source::width; ++pattern) {
    const Source source = of_pattern<Source>(pattern);
    const double wanted = fitted<Target>(source.to_double());
    ASSERT_EQ(Target(source).to_double(), wanted)
        << source.to_double() << " mode " << Target::qmode << " " << Target::omode;
    ASSERT_EQ(Target(source.to_double()).to_double(), wanted)
        << source.to_double() << " mode " << Target::qmode << " " << Target::omode << " from floating point";
  }
}

template <ap_q_mode Q, ap_o_mode O>
void check_modes() {
  using from_signed = ap_fixed<9, 5>;
  using from_unsigned = ap_ufixed<8, 3>;
  check_conversion<from_signed, ap_fixed<5, 3, Q, O>>();
  check_conversion<from_signed, ap_ufixed<4, 3, Q, O>>();
  check_conversion<from_unsigned, ap_fixed<4, 2, Q, O>>();
  check_conversion<from_unsigned, ap_ufixed<3, 2, Q, O>>();
  check_conversion<from_signed, ap_fixed<12, 4, Q, O>>();  // more fraction bits, less integer bits
  check_conversion<from_signed, ap_fixed<3, 6, Q, O>>();   // I > W: multiples of 8
  check_conversion<from_unsigned, ap_fixed<3, -2, Q, O>>();
  check_conversion<ap_fixed<4, -3>, ap_fixed<2, 1, Q, O>>();  // all bits are dropped, and more
}

template <ap_q_mode Q>
void check_overflow_modes() {
  check_modes<Q, AP_WRAP>();
  check_modes<Q, AP_SAT>();
  check_modes<Q, AP_SAT_ZERO>();
  check_modes<Q, AP_SAT_SYM>();
}

TEST(ap_fixed, rounds_and_limits_by_its_modes) {
  check_overflow_modes<AP_TRN>();
  check_overflow_modes<AP_TRN_ZERO>();
  check_overflow_modes<AP_RND>();
  check_overflow_modes<AP_RND_ZERO>();
  check_overflow_modes<AP_RND_MIN_INF>();
  check_overflow_modes<AP_RND_INF>();
  check_overflow_modes<AP_RND_CONV>();
}

template <class A, class B>
void check_operators() {
  for (int i = 0; i < 1 << A::width; ++i)
    for (int k = 0; k < 1 << B::width; ++k) {
      const A a = of_pattern<A>(i);
      const B b = of_pattern<B>(k);
      const double x = a.to_double(), y = b.to_double();
      ASSERT_EQ((a + b).to_double(), x + y);
      ASSERT_EQ((a - b).to_double(), x - y);
      ASSERT_EQ((a * b).to_double(), x * y);
      ASSERT_EQ(a < b, x < y);
      ASSERT_EQ(a >= b, x >= y);
      ASSERT_EQ(a == b, x == y);
      for (const double near : {y, y + 0.3, y - 0.0001, y * 1e200}) {
        ASSERT_EQ(a > near, x > near) << "with a floating point constant";
        ASSERT_EQ(near <= a, near <= x);
        ASSERT_EQ(a == near, x == near);
      }
      if (y != 0) {
        const auto quotient = a / b;
        const double bits = std::ldexp(1, decltype(quotient)::fraction);
        ASSERT_EQ(quotient.to_double(), std::trunc(x / y * bits) / bits) << x << " / " << y;
      }
    }
}

TEST(ap_fixed, operators_are_exact) {
  check_operators<ap_fixed<6, 3>, ap_fixed<5, 2>>();
  check_operators<ap_fixed<5, 1>, ap_ufixed<4, 4>>();
  check_operators<ap_ufixed<5, 3>, ap_fixed<4, 2>>();
  check_operators<ap_ufixed<5, 2>, ap_ufixed<4, -1>>();
}

TEST(ap_fixed, result_types_are_the_vendors) {
  using a = ap_fixed<16, 4>;
  using b = ap_ufixed<10, 6>;
  const a x = 1;
  const b y = 1;
  static_assert(std::is_same_v<decltype(x + y), ap_fixed<20, 8>>);
  static_assert(std::is_same_v<decltype(x - x), ap_fixed<17, 5>>);
  static_assert(std::is_same_v<decltype(y - y), ap_fixed<11, 7>>);
  static_assert(std::is_same_v<decltype(x * y), ap_fixed<26, 10>>);
  static_assert(std::is_same_v<decltype(x / y), ap_fixed<20, 8>>);
  static_assert(std::is_same_v<decltype(y / x), ap_fixed<23, 19>>);
  static_assert(std::is_same_v<decltype(x * 2), ap_fixed<48, 36>>);
  static_assert(std::is_same_v<decltype(x << 2), a>);
  static_assert(std::is_same_v<decltype(-x), ap_fixed<17, 5>>);
  EXPECT_EQ((x * 2).to_double(), 2);
}

TEST(ap_fixed, integers_take_part_and_come_out_cut_toward_zero) {
  ap_fixed<12, 6> x = -7.5;
  EXPECT_EQ(int(x), -7);
  EXPECT_EQ(x.to_int(), -7);
  const ap_int<5> integer = x;
  EXPECT_EQ(integer, -7);
  EXPECT_EQ(int(ap_fixed<8, 4>(-0.5)), 0);
  EXPECT_EQ(unsigned(ap_ufixed<8, 6>(33.75)), 33u);
  EXPECT_TRUE(bool(ap_fixed<8, 4>(0.25)));
  EXPECT_EQ((x + ap_uint<3>(2)).to_double(), -5.5);
  EXPECT_EQ((1 - x).to_double(), 8.5);
  EXPECT_TRUE(x < 0);
  EXPECT_TRUE(-8 < x);
  x += 1;
  EXPECT_EQ(x.to_double(), -6.5);
  EXPECT_EQ((++x).to_double(), -5.5);
  EXPECT_EQ((x++).to_double(), -5.5);
  x *= 2;
  EXPECT_EQ(x.to_double(), -9);
  x /= 4;
  EXPECT_EQ(x.to_double(), -2.25);
}

TEST(ap_fixed, shifts_keep_the_type_and_lose_bits) {
  const ap_fixed<6, 3> x = -2.375;
  EXPECT_EQ((x >> 1).to_double(), -1.25);
  EXPECT_EQ((x << 1).to_double(), 3.25);  // wrapped
  EXPECT_EQ((x >> ap_uint<4>(9)).to_double(), -0.125);
}

TEST(ap_fixed, bits_are_those_of_the_integer) {
  ap_ufixed<8, 4> x = 5.0625;
  EXPECT_EQ(x.range(), 0x51u);
  EXPECT_EQ(x.V, 0x51);
  EXPECT_TRUE(x[0]);
  x.range(3, 0) = 8;
  EXPECT_EQ(x.to_double(), 5.5);
  x[7] = 1;
  EXPECT_EQ(x.to_double(), 13.5);
  EXPECT_EQ((x & ap_ufixed<8, 4>(0.75)).to_double(), 0.5);
  EXPECT_EQ((~x).to_double(), 2.4375);
}

TEST(ap_fixed, constants_of_any_size_are_converted) {
  constexpr ap_fixed<16, 2> folded = 0.7071067811865476;
  static_assert(folded.V == 11585);
  using saturated = ap_fixed<8, 4, AP_RND, AP_SAT>;
  EXPECT_EQ(saturated(1e300).to_double(), 7.9375);
  EXPECT_EQ(saturated(-std::numeric_limits<double>::infinity()).to_double(), -8);
  EXPECT_EQ(saturated(std::numeric_limits<double>::quiet_NaN()).to_double(), 0);
  EXPECT_EQ((ap_fixed<8, 4>(1e300).to_double()), 0);
  EXPECT_EQ((ap_fixed<8, 4>(-1e-300).to_double()), -0.0625) << "toward minus infinity";
  EXPECT_EQ((ap_fixed<8, 4, AP_RND>(-1e-300).to_double()), 0);
  EXPECT_EQ((ap_fixed<8, 4, AP_RND_INF>(std::ldexp(1, -5) - std::ldexp(1, -56)).to_double()), 0) << "not yet a half";
  EXPECT_EQ((ap_fixed<80, 40>(std::ldexp(1, 38) + std::ldexp(1, -10)).to_double()),
            std::ldexp(1, 38) + std::ldexp(1, -10));
}

}  // namespace
