// A class's `static const int` has no definition: an operator that took it by reference would not link. Without
// optimisation, where every reference wants its object (CMakeLists.txt).
#include <ap_fixed.h>
#include <ap_int.h>
#include <gtest/gtest.h>

namespace {

struct configuration {
  static const int shift = 3;
  static const unsigned mask = 0x0f;
  static const bool enabled = true;
  enum mode { wide = 5 };
};

using byte = ap_uint<8>;

TEST(class_constants, are_operands_on_either_side) {
  const byte x = 0x5a;
  EXPECT_EQ((x >> configuration::shift).to_int(), 0x0b);
  EXPECT_EQ((x << configuration::shift).to_int(), 0xd0);
  EXPECT_EQ((x + configuration::shift).to_int(), 0x5d);
  EXPECT_EQ((configuration::shift - x).to_int(), 3 - 0x5a);
  EXPECT_EQ((x * configuration::mask).to_int(), 0x5a * 15);
  EXPECT_EQ((x / configuration::shift).to_int(), 30);
  EXPECT_EQ((x % configuration::mask).to_int(), 0);
  EXPECT_EQ((x & configuration::mask).to_int(), 0x0a);
  EXPECT_EQ((configuration::mask | x).to_int(), 0x5f);
  EXPECT_EQ((x ^ configuration::enabled).to_int(), 0x5b);
  EXPECT_EQ((x + configuration::wide).to_int(), 0x5f);
  EXPECT_EQ(configuration::shift << ap_uint<3>(2), 12);
  EXPECT_TRUE(x > configuration::shift);
  EXPECT_TRUE(configuration::mask <= x);
  EXPECT_FALSE(x == configuration::mask);
}

TEST(class_constants, are_assigned_and_compounded) {
  byte x = 0x5a;
  x >>= configuration::shift;
  EXPECT_EQ(x.to_int(), 0x0b);
  x += configuration::mask;
  EXPECT_EQ(x.to_int(), 0x1a);
  x.range(7, 4) = configuration::mask;
  EXPECT_EQ(x.to_int(), 0xfa);
  x[0] = configuration::enabled;
  EXPECT_EQ(x.to_int(), 0xfb);
  x.range(3, 0) += configuration::shift;
  EXPECT_EQ(x.to_int(), 0xfe);
  byte low = 0;
  (x, low) = configuration::shift;
  EXPECT_EQ(x.to_int(), 0);
  EXPECT_EQ(low.to_int(), 3);
  EXPECT_EQ((x, configuration::shift).length(), 8 + 32);
}

TEST(class_constants, meet_fixed_point) {
  using number = ap_fixed<16, 8>;
  number x = configuration::shift;
  EXPECT_TRUE(x == configuration::shift);
  EXPECT_TRUE(x < configuration::mask);
  x = x + configuration::shift;
  EXPECT_TRUE(x == 6);
  x *= configuration::shift;
  EXPECT_TRUE(x == 18);
  x >>= configuration::shift;
  EXPECT_TRUE(x == number(2.25));
  EXPECT_TRUE((x << configuration::shift) == 18);
  EXPECT_TRUE((configuration::shift - x) == number(0.75));
}

}  // namespace
