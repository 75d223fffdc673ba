// What only the native build has: text, floating point, errors.

#include <ap_int.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace {

template <class T>
std::string printed(const T& v) {
  std::ostringstream out;
  out << v;
  return out.str();
}

TEST(ap_int_text, writes_every_radix) {
  EXPECT_EQ(ap_uint<8>(200).to_string(10), "200");
  EXPECT_EQ(ap_uint<8>(200).to_string(16), "0xc8");
  EXPECT_EQ(ap_uint<8>(200).to_string(8), "0o310");
  EXPECT_EQ(ap_uint<8>(200).to_string(2), "0b11001000");
  EXPECT_EQ(ap_uint<8>(5).to_string(), "0b101");
  EXPECT_EQ(ap_uint<8>(0).to_string(10), "0");
  EXPECT_EQ(ap_int<8>(-128).to_string(10), "-128");
  EXPECT_EQ(ap_int<8>(-100).to_string(16), "-0x64");
  EXPECT_EQ(ap_int<8>(-100).to_string(16, false), "0x9c");
  EXPECT_EQ(ap_int<8>(-100).to_string(10, false), "156");
  EXPECT_EQ(ap_int<8>(-1).to_string(2), "0b11111111");
  EXPECT_EQ(ap_int<1>(-1).to_string(10), "-1");
  EXPECT_EQ((~ap_uint<128>(0)).to_string(10), "340282366920938463463374607431768211455");
  EXPECT_EQ((ap_uint<200>(1) << 199).to_string(10), "803469022129495137770981046170581301261101496891396417650688");
  EXPECT_EQ(ap_uint<8>(0xa5)(7, 4).to_string(16), "0xa");
  EXPECT_EQ((ap_uint<4>(10), ap_uint<4>(5)).to_string(16), "0xa5");
  EXPECT_THROW(ap_uint<8>(1).to_string(7), std::invalid_argument);
}

TEST(ap_int_text, reads_every_radix) {
  EXPECT_EQ(ap_uint<8>("200"), 200);
  EXPECT_EQ(ap_uint<8>("0xc8"), 200);
  EXPECT_EQ(ap_uint<8>("0o310"), 200);
  EXPECT_EQ(ap_uint<8>("0b11001000"), 200);
  EXPECT_EQ(ap_uint<8>("c8", 16), 200);
  EXPECT_EQ(ap_uint<8>("0XC8", 16), 200);
  EXPECT_EQ(ap_uint<12>("0b1", 16), 0xb1);
  EXPECT_EQ(ap_uint<8>("11001000", 2), 200);
  EXPECT_EQ(ap_uint<8>("310", 8), 200);
  EXPECT_EQ(ap_int<8>("-100"), -100);
  EXPECT_EQ(ap_int<8>("+100"), 100);
  EXPECT_EQ(ap_int<8>("-0x64"), -100);
  EXPECT_EQ(ap_uint<8>("456"), 200);  // modulo 2^8
  EXPECT_EQ(ap_uint<8>("0"), 0);
  EXPECT_EQ(ap_uint<8>(std::string("17")), 17);
  const ap_uint<8> assigned = "19";
  EXPECT_EQ(assigned, 19);
  const std::string large = "803469022129495137770981046170581301261101496891396417650688";
  EXPECT_EQ(ap_uint<200>(large), ap_uint<200>(1) << 199);
}

TEST(ap_int_text, refuses_what_is_no_number) {
  for (const char* text : {"", "-", "0x", "12a", "0b2", "0o8", "1 2", "x1", "--1"}) {
    EXPECT_THROW(ap_uint<8>{text}, std::invalid_argument) << text;
  }
  EXPECT_THROW(ap_uint<8>("8", 8), std::invalid_argument);
  EXPECT_THROW(ap_uint<8>("0x1", 10), std::invalid_argument);
  EXPECT_THROW(ap_uint<8>("1", 3), std::invalid_argument);
}

TEST(ap_int_text, goes_through_standard_streams) {
  EXPECT_EQ(printed(ap_uint<8>(65)), "65");
  EXPECT_EQ(printed(ap_int<200>(-65)), "-65");
  EXPECT_EQ(printed(ap_uint<8>(0xa5)(7, 4)), "10");
  EXPECT_EQ(printed(ap_uint<8>(0xa5)[0]), "1");
  EXPECT_EQ(printed((ap_uint<8>(1), ap_uint<8>(1))), "257");
  std::ostringstream out;
  out << std::hex << ap_uint<8>(255) << ' ' << std::oct << ap_uint<8>(8);
  EXPECT_EQ(out.str(), "0xff 0o10");

  std::istringstream in("12 0x1f -3 word");
  ap_uint<8> a, b;
  ap_int<8> c;
  in >> a >> b >> c;
  EXPECT_TRUE(in);
  EXPECT_EQ(a, 12);
  EXPECT_EQ(b, 31);
  EXPECT_EQ(c, -3);
  EXPECT_FALSE(in >> a);
  EXPECT_EQ(a, 12);
  std::istringstream hexadecimal("ff");
  hexadecimal >> std::hex >> a;
  EXPECT_EQ(a, 255);
}

TEST(ap_int_floating, truncates_toward_zero) {
  EXPECT_EQ(ap_int<8>(-3.7), -3);
  EXPECT_EQ(ap_int<8>(3.7), 3);
  EXPECT_EQ(ap_uint<8>(0.99f), 0);
  EXPECT_EQ(ap_uint<8>(256.5), 0);
  EXPECT_EQ(ap_int<8>(200.0), -56);
  EXPECT_EQ(ap_uint<100>(std::ldexp(1.0, 99)), ap_uint<100>(1) << 99);
  EXPECT_EQ(ap_int<200>(-std::ldexp(3.0, 150)), -(ap_int<200>(3) << 150));
  EXPECT_EQ(ap_uint<8>(1e300), 0);
  ap_uint<8> x;
  x = 4.5;
  EXPECT_EQ(x, 4);
}

TEST(ap_int_floating, converts_to_floating_point) {
  EXPECT_EQ(ap_int<8>(-100).to_double(), -100.0);
  EXPECT_EQ(ap_uint<8>(200).to_float(), 200.0f);
  EXPECT_EQ((ap_uint<200>(3) << 150).to_double(), std::ldexp(3.0, 150));
  EXPECT_EQ((ap_int<64>(1) << 63).to_double(), -std::ldexp(1.0, 63));
  EXPECT_EQ(ap_uint<8>(3) * 0.5, 1.5);
  EXPECT_EQ(1.0 / ap_int<4>(-4), -0.25);
}

TEST(ap_int_floating, refuses_what_has_no_value) {
  EXPECT_THROW(ap_int<8>{std::numeric_limits<double>::quiet_NaN()}, std::invalid_argument);
  EXPECT_THROW(ap_int<8>{std::numeric_limits<float>::infinity()}, std::invalid_argument);
}

using ap_int_errors_death_test = ::testing::Test;

TEST(ap_int_errors_death_test, name_the_bit_and_the_width) {
  ap_uint<13> x = 0;
  volatile int index = 13;
  EXPECT_DEATH(x[index] = 1, "bit index 13 is outside a value of 13 bits");
  index = -1;
  EXPECT_DEATH(x[index] = 1, "bit index -1 is outside a value of 13 bits");
  EXPECT_DEATH((void)x.test(index), "bit index -1");
  EXPECT_DEATH(x.set(index), "bit index -1");
  EXPECT_DEATH(x.clear(index), "bit index -1");
  EXPECT_DEATH(x.invert(index), "bit index -1");
  index = 13;
  EXPECT_DEATH(x.lrotate(index), "index 13");
  EXPECT_DEATH(x.rrotate(index), "index 13");
}

TEST(ap_int_errors_death_test, name_the_range_and_the_width) {
  ap_uint<13> x = 0;
  volatile int index = 13;
  EXPECT_DEATH((void)x(index, 0).get(), "range\\(13, 0\\) is outside a value of 13 bits");
  EXPECT_DEATH((void)x(0, index).get(), "range\\(0, 13\\)");
  index = -1;
  EXPECT_DEATH((void)x.range(3, index).get(), "range\\(3, -1\\)");
  EXPECT_DEATH((void)x.range(index, 3).get(), "range\\(-1, 3\\)");
}

TEST(ap_int_errors, report_a_division_by_zero) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(ap_uint<8>(200) / ap_int<4>(0), -1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "ap_int: division of ap_uint<8> by an ap_int<4> that is zero: quotient all ones, remainder dividend\n");
}

}  // namespace
