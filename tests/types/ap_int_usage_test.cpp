// The integers as kernels use them: proxies, conversions, mixed operands, control flow. What stands here must compile
// without ambiguity and mean what the vendors' headers mean by it. Built natively and for synthesis.

#include <ap_int.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

TEST(ap_int_usage, default_construction_is_trivial_and_value_initialisation_zero) {
  static ap_uint<8> at_rest[3];
  EXPECT_EQ(at_rest[2], 0);
  EXPECT_EQ(ap_uint<8>(), 0);
  struct pixel {
    ap_uint<8> red;
    ap_int<200> wide;
  };
  const pixel p{};
  EXPECT_EQ(p.red, 0);
  EXPECT_EQ(p.wide, 0);
}

TEST(ap_int_usage, converts_to_c_integers_by_the_low_bits) {
  const ap_int<13> x = -5;
  const int as_int = x;
  const long long as_long = x;
  const bool as_bool = x;
  EXPECT_EQ(as_int, -5);
  EXPECT_EQ(as_long, -5);
  EXPECT_TRUE(as_bool);
  const ap_uint<40> y = 0x12345678ffLL;
  EXPECT_EQ(y.to_int(), 0x345678ff);
  EXPECT_EQ(y.to_uint(), 0x345678ffu);
  EXPECT_EQ(y.to_int64(), 0x12345678ffLL);
  EXPECT_EQ(y.to_uint64(), 0x12345678ffull);
  EXPECT_EQ(y.to_long(), 0x12345678ffL);
  EXPECT_EQ(y.to_ulong(), 0x12345678fful);
  EXPECT_EQ(y.to_uchar(), 0xff);
  EXPECT_EQ(y.to_schar(), -1);
  EXPECT_EQ(y.to_short(), 0x78ff);
  EXPECT_EQ(y.to_ushort(), 0x78ff);
  EXPECT_EQ(y.to_char(), static_cast<char>(0xff));
  EXPECT_TRUE(y.to_bool());
  EXPECT_EQ(y.length(), 40);
  EXPECT_FALSE(y.is_zero());
}

TEST(ap_int_usage, converts_to_bool_as_not_zero_at_every_width) {
  const ap_uint<100> high_bit_only = ap_uint<100>(1) << 99;
  EXPECT_EQ(high_bit_only.to_uint64(), 0u);
  const bool by_initialisation = high_bit_only;
  EXPECT_TRUE(by_initialisation);
  EXPECT_TRUE(high_bit_only ? true : false);
  EXPECT_FALSE(!high_bit_only);
  EXPECT_TRUE(high_bit_only && true);
  const ap_uint<2> even = 2;
  EXPECT_TRUE(even ? true : false);
}

enum state { idle, run, stop };

int dispatch(ap_uint<2> s) {
  switch (s) {
    case idle:
      return 10;
    case run:
      return 20;
    default:
      return 30;
  }
}

TEST(ap_int_usage, works_in_control_flow_and_as_index) {
  EXPECT_EQ(dispatch(idle), 10);
  EXPECT_EQ(dispatch(run), 20);
  EXPECT_EQ(dispatch(stop), 30);
  ap_uint<2> s = run;
  EXPECT_TRUE(s == run);
  EXPECT_TRUE(run == s);
  EXPECT_TRUE(s != idle);
  s = stop;
  EXPECT_TRUE(s > run);
  const int table[4] = {7, 8, 9, 10};
  EXPECT_EQ(table[s], 9);
  EXPECT_EQ(*(table + s), 9);
  int sum = 0;
  for (ap_uint<4> i = 0; i < 10; i++) sum += i;
  EXPECT_EQ(sum, 45);
  int steps = 0;
  for (ap_int<5> i = 3; i >= 0; --i, ++steps) {
  }
  EXPECT_EQ(steps, 4);
  const ap_uint<8> a = 3, b = 5;
  EXPECT_EQ(std::min(a, b), 3);
  EXPECT_EQ(std::max<int>(a, b), 5);
  EXPECT_EQ((a < b ? a : b), 3);
  EXPECT_TRUE(a && b);
}

TEST(ap_int_usage, shifts_a_c_integer_as_c_does) {
  const ap_uint<5> n = 4;
  static_assert(std::is_same_v<decltype(1 << n), int>);
  static_assert(std::is_same_v<decltype(1u << n), unsigned>);
  EXPECT_EQ(1 << n, 16);
  EXPECT_EQ(256 >> n, 16);
  int x = 3;
  x += n;
  EXPECT_EQ(x, 7);
}

TEST(ap_int_usage, ranges_are_unsigned_and_writable) {
  ap_int<8> x = -86;  // 0xaa
  EXPECT_EQ(x.range(7, 4), 0xa);
  EXPECT_EQ(x(7, 4) + 1, 0xb);
  EXPECT_EQ(x.range(), 0xaa);
  EXPECT_EQ(ap_uint<8>(0xa5).range(4, 7), 5);
  x(3, 0) = 0x123;  // an over-wide source is cut
  EXPECT_EQ(x, static_cast<signed char>(0xa3));
  x(7, 4) = x(3, 0);
  EXPECT_EQ(x.to_uchar(), 0x33);
  x(3, 0) += 14;
  EXPECT_EQ(x.to_uchar(), 0x31);
  x(3, 0) <<= 1;
  EXPECT_EQ(x.to_uchar(), 0x32);
  const ap_uint<3> high = 6, low = 2;
  EXPECT_EQ(x(high, low), 0xc);
  const ap_uint<8> y = 0x53;
  EXPECT_TRUE(x(7, 4) != y(7, 4));
  EXPECT_TRUE(x(0, 0) < y(1, 0));
  EXPECT_EQ(x(7, 4).to_int(), 3);
  EXPECT_EQ(x(7, 4).to_uint(), 3u);
  EXPECT_EQ(x(7, 4).to_int64(), 3);
  EXPECT_EQ(x(7, 4).to_uint64(), 3u);
  EXPECT_EQ(x(7, 4).length(), 4);
  EXPECT_TRUE(x(5, 4).and_reduce());
  EXPECT_FALSE(x(6, 4).and_reduce());
  EXPECT_TRUE(x(6, 4).nand_reduce());
  EXPECT_TRUE(x(7, 6).nor_reduce());
  EXPECT_TRUE(x(4, 4).or_reduce());
  EXPECT_FALSE(x(5, 4).xor_reduce());
  EXPECT_TRUE(x(5, 4).xnor_reduce());
  EXPECT_EQ((high == 6 ? x(7, 4) : x(3, 0)), 3);
}

TEST(ap_int_usage, bits_are_writable_and_count_as_one_bit_operands) {
  ap_uint<8> x = 0;
  const ap_uint<8> y = 0x82;
  x[3] = 1;
  x[0] = y[7];
  x[1] = x[3];
  x[4] = 6;  // any value that is not zero
  x.bit(5) = y.bit(1);
  EXPECT_EQ(x, 0x3b);
  x[5] ^= 1;
  x[4] &= y[0];
  x[7] |= true;
  EXPECT_EQ(x, 0x8b);
  EXPECT_EQ(x[3] + x[1], 2);
  EXPECT_FALSE(~x[3]);
  EXPECT_FALSE(!x[3]);
  EXPECT_EQ((x[2] ? 1 : 2), 2);
  EXPECT_TRUE(x[3] == y[1]);
  EXPECT_EQ((y[1] ? x[0] : x[2]), true);
  const ap_uint<3> index = 7;
  EXPECT_TRUE(x[index]);
  x.clear(7);
  x.set(6);
  x.set_bit(0, false);
  EXPECT_EQ(x, 0x4a);
  EXPECT_TRUE(x.get_bit(6));
  x.b_not();
  EXPECT_EQ(x, 0xb5);
}

TEST(ap_int_usage, concatenates_values_ranges_bits_and_c_values) {
  const ap_uint<4> a = 0xa;
  const ap_int<4> b = -1;
  EXPECT_EQ((a, b), 0xaf);
  EXPECT_EQ((a, b, a), 0xafa);
  EXPECT_EQ(a.concat(b), 0xaf);
  const ap_uint<8> x = 0x5c;
  EXPECT_EQ((x(3, 0), x(7, 4)).get(), 0xc5);
  EXPECT_EQ((x[2], x[1], x[0]), 4);
  EXPECT_EQ((true, a), 0x1a);
  EXPECT_EQ((a, ap_uint<2>(1)), 0x29);
  EXPECT_EQ((a + a, a), 0x14a);
  const ap_uint<8> joined = (x(3, 0), a);
  EXPECT_EQ(joined, 0xca);
  EXPECT_EQ((a, b) + 1, 0xb0);
  EXPECT_EQ((a, b).length(), 8);
  EXPECT_EQ((a, b).to_int(), 0xaf);
}

TEST(ap_int_usage, concatenations_are_assignable) {
  ap_uint<4> high;
  ap_int<3> low;
  (high, low) = 0x5d;
  EXPECT_EQ(high, 0xb);
  EXPECT_EQ(low, -3);
  ap_uint<8> x = 0;
  (x(3, 0), x(7, 4)) = 0x12;
  EXPECT_EQ(x, 0x21);
  (x[0], x[7]) = 1;
  EXPECT_EQ(x, 0xa0);
  ap_uint<8> a = 1, b = 2;
  (a, b) = (b, a);
  EXPECT_EQ(a, 2);
  EXPECT_EQ(b, 1);
  auto bit = a[7];
  (bit, b) = 0x1ff;
  EXPECT_EQ(a, 0x82);
  EXPECT_EQ(b, 0xff);
  a.concat(b) = 0x1234;
  EXPECT_EQ(a, 0x12);
  EXPECT_EQ(b, 0x34);
}

TEST(ap_int_usage, copying_a_proxy_writes_through) {
  ap_uint<8> x = 0x0f, y = 0xa0;
  x(7, 4) = y(7, 4);
  EXPECT_EQ(x, 0xaf);
  auto nibble = x(3, 0);
  nibble = y(7, 4);
  EXPECT_EQ(x, 0xaa);
}

TEST(ap_int_usage, divides_by_zero_with_a_defined_result) {
  const ap_uint<8> x = 200;
  const ap_int<8> y = -3;
  const ap_uint<4> none = 0;
  EXPECT_EQ(x / none, 255);
  EXPECT_EQ(y / none, -1);
  EXPECT_EQ(x / ap_int<4>(0), -1);
  EXPECT_EQ(y % none, -3);
  EXPECT_EQ(x % none, 200 % 16);  // the dividend, cut to the remainder's four bits
  EXPECT_EQ(ap_uint<200>(7) % ap_uint<200>(0), 7);
}

template <int W>
constexpr int width_of(ap_uint<W>) {
  return W;
}

struct coordinate : ap_uint<10> {
  using ap_uint<10>::ap_int_base;
};

TEST(ap_int_usage, deduces_widths_and_serves_as_a_base_class) {
  EXPECT_EQ(width_of(ap_uint<13>(1)), 13);
  EXPECT_EQ(width_of(ap_uint<13>(1) + ap_uint<13>(1)), 14);
  coordinate c = 1023;
  EXPECT_EQ(c + 1, 1024);
  EXPECT_EQ((c, ap_uint<1>(1)), 2047);
  c += 2;
  EXPECT_EQ(c, 1);
}

TEST(ap_int_usage, is_usable_at_compile_time) {
  constexpr ap_uint<8> x = 200;
  static_assert(x + x == 400);
  static_assert(x(7, 4) == 12 && x[7] && !x[0]);
  static_assert((x, x) == 51400);
  static_assert(((ap_uint<300>(x) << 250) >> 250) == x);
  static_assert(x.xor_reduce() && x.countLeadingZeros() == 0);
  static_assert(std::numeric_limits<ap_uint<9>>::max() == 511 && std::numeric_limits<ap_uint<9>>::min() == 0);
  static_assert(std::numeric_limits<ap_int<9>>::max() == 255 && std::numeric_limits<ap_int<9>>::lowest() == -256);
}

}  // namespace
