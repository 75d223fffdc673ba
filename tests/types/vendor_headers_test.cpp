// ap_shift_reg.h, hls_vector.h, hls_math.h, hls_print.h and ap_utils.h against their meaning in plain C++.
#include <ap_shift_reg.h>
#include <ap_utils.h>
#include <gtest/gtest.h>
#include <hls_math.h>
#include <hls_print.h>
#include <hls_vector.h>

#include <cmath>
#include <deque>
#include <random>

namespace {

// ---- ap_shift_reg ----
template <unsigned N>
void compare_with_a_queue() {
  static ap_shift_reg<ap_uint<16>, N> shifted("name");
  std::deque<unsigned> model(N, 0);
  std::mt19937 random(N);
  for (unsigned step = 0; step < 5 * N; ++step) {
    const unsigned value = static_cast<unsigned>(random()) & 0xffff;
    const unsigned address = static_cast<unsigned>(random()) % N;
    const bool enable = random() % 4 != 0;
    ASSERT_EQ(shifted.read(address).to_uint(), model[address]);
    ASSERT_EQ(shifted.read().to_uint(), model.back());
    ASSERT_EQ(shifted.shift(value, address, enable).to_uint(), model[address]) << "the value before the shift";
    if (!enable) continue;
    model.push_front(value);
    model.pop_back();
  }
}

TEST(ap_shift_reg, is_a_queue_of_registers) {
  compare_with_a_queue<1>();
  compare_with_a_queue<5>();
  compare_with_a_queue<64>();
}

TEST(ap_shift_reg, is_a_queue_in_memory) {
  compare_with_a_queue<65>();
  compare_with_a_queue<200>();
}

TEST(ap_shift_reg, delays_by_its_length_without_an_address) {
  ap_shift_reg<int, 3> line;
  const int wanted[] = {0, 0, 0, 10, 11};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(line.shift(10 + i), wanted[i]);
}

TEST(ap_shift_reg, stops_at_an_address_outside) {
  ap_shift_reg<int, 3> line;
  EXPECT_DEATH((void)line.read(3), "address 3 is outside of 3 values");
  EXPECT_DEATH((void)line.shift(1, 7), "address 7 is outside of 3 values");
}

// ---- hls::vector ----
using quad = hls::vector<ap_int<8>, 4>;

TEST(hls_vector, is_made_of_values_or_of_one) {
  const quad v = {1, -2, 3, 127};
  EXPECT_EQ(v[1].to_int(), -2);
  EXPECT_EQ(v[3].to_int(), 127);
  quad w(5);
  EXPECT_EQ(w[0].to_int() + w[3].to_int(), 10);
  w.fill(-1);
  EXPECT_EQ(w[2].to_int(), -1);
  w = 3;
  EXPECT_EQ(w[1].to_int(), 3);
  EXPECT_EQ(quad::size(), 4u);
  int sum = 0;
  for (const ap_int<8>& element : v) sum += element.to_int();
  EXPECT_EQ(sum, 129);
}

TEST(hls_vector, computes_element_by_element_in_its_own_type) {
  const quad v = {100, -2, 7, 127};
  const quad w = {100, 3, -2, 2};
  const int sums[] = {-56, 1, 5, -127}, products[] = {16, -6, -14, -2}, quotients[] = {1, 0, -3, 63};
  const int rests[] = {0, -2, 1, 1}, both[] = {100, 2, 6, 2}, differ[] = {0, -3, -7, 125};
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_EQ((v + w)[i].to_int(), sums[i]);
    EXPECT_EQ((v * w)[i].to_int(), products[i]);
    EXPECT_EQ((v / w)[i].to_int(), quotients[i]);
    EXPECT_EQ((v % w)[i].to_int(), rests[i]);
    EXPECT_EQ((v & w)[i].to_int(), both[i]);
    EXPECT_EQ((v ^ w)[i].to_int(), differ[i]);
    EXPECT_EQ((v | w)[i].to_int(), (ap_int<8>(v[i] | w[i])).to_int());
    EXPECT_EQ((v - w)[i].to_int(), (ap_int<8>(v[i] - w[i])).to_int());
    EXPECT_EQ((v >> 1)[i].to_int(), (ap_int<8>(v[i] >> 1)).to_int());
    EXPECT_EQ((v << 1)[i].to_int(), (ap_int<8>(v[i] << 1)).to_int());
    EXPECT_EQ((1 - v)[i].to_int(), (ap_int<8>(1 - v[i])).to_int());
    EXPECT_EQ((-v)[i].to_int(), (ap_int<8>(-v[i])).to_int());
    EXPECT_EQ((~v)[i].to_int(), ~v[i].to_int());
  }
  quad x = v;
  x += 1;
  x *= w;
  EXPECT_EQ(x[2].to_int(), -16);
  EXPECT_EQ((x++)[2].to_int(), -16);
  EXPECT_EQ((--x)[2].to_int(), -16);
}

TEST(hls_vector, compares_by_the_first_difference) {
  const quad a = {1, 2, 3, 4}, b = {1, 2, 4, 0};
  EXPECT_TRUE(a == a);
  EXPECT_TRUE(a != b);
  EXPECT_TRUE(a < b);
  EXPECT_TRUE(b > a);
  EXPECT_TRUE(a <= a);
  EXPECT_FALSE(a >= b);
}

TEST(hls_vector, reduces_all_elements) {
  const hls::vector<int, 5> v = {3, 5, 6, 12, 7};
  EXPECT_EQ(v.reduce_add(), 33);
  EXPECT_EQ(v.reduce_mult(), 7560);
  EXPECT_EQ(v.reduce_and(), 0);
  EXPECT_EQ(v.reduce_or(), 15);
  EXPECT_EQ(v.reduce_xor(), 3 ^ 5 ^ 6 ^ 12 ^ 7);
  EXPECT_EQ((hls::vector<int, 1>(9)).reduce_add(), 9);
}

// ---- hls_math.h ----
TEST(hls_math, roots_of_integers_are_exact) {
  for (unsigned x = 0; x < 4096; ++x)
    ASSERT_EQ(hls::sqrt(ap_uint<12>(x)).to_uint(), static_cast<unsigned>(std::sqrt(static_cast<double>(x))));
  for (int x = -128; x < 128; ++x)
    ASSERT_EQ(hls::sqrt(ap_int<8>(x)).to_int(), x < 0 ? 0 : static_cast<int>(std::sqrt(static_cast<double>(x))));
  EXPECT_EQ(hls::sqrt(2147483647), 46340);
  EXPECT_EQ(hls::sqrt(4294967295u), 65535u);
  EXPECT_EQ(hls::sqrt(ap_uint<1>(1)).to_int(), 1);
}

TEST(hls_math, roots_of_fixed_point_are_cut) {
  using number = ap_fixed<12, 5>;
  for (int bits = -2048; bits < 2048; ++bits) {
    const number x = number::from_bits(bits);
    const double root = x.to_double() < 0 ? 0 : std::sqrt(x.to_double());
    ASSERT_EQ(hls::sqrt(x).to_double(), std::floor(root * 128) / 128) << x.to_double();
  }
  EXPECT_EQ(hls::sqrt(ap_ufixed<8, 0>(0.25)).to_double(), 0.5);
  using coarse = ap_ufixed<6, 10>;  // multiples of 16
  EXPECT_EQ(hls::sqrt(coarse(1008)).to_double(), 16);
}

TEST(hls_math, rounds_fixed_point) {
  using number = ap_fixed<10, 6>;
  for (int bits = -512; bits < 512; ++bits) {
    const number x = number::from_bits(bits);
    const double v = x.to_double();
    ASSERT_EQ(hls::floor(x).to_double(), std::floor(v));
    ASSERT_EQ(hls::trunc(x).to_double(), std::trunc(v));
    const auto kept = [](double exact) { return number(exact).to_double(); };
    ASSERT_EQ(hls::ceil(x).to_double(), kept(std::ceil(v)));
    ASSERT_EQ(hls::round(x).to_double(), kept(std::round(v)));
    ASSERT_EQ(hls::rint(x).to_double(), kept(std::nearbyint(v)));
    ASSERT_EQ(hls::signbit(x), v < 0);
    ASSERT_EQ(hls::abs(x).to_double(), kept(std::fabs(v)));
    ASSERT_EQ(hls::copysign(x, number(-1)).to_double(), -std::fabs(v));
  }
}

TEST(hls_math, chooses_of_mixed_types) {
  EXPECT_EQ(hls::max(ap_int<4>(-3), ap_uint<8>(200)).to_int(), 200);
  EXPECT_EQ(hls::min(ap_int<4>(-3), ap_uint<8>(200)).to_int(), -3);
  EXPECT_EQ(hls::max(ap_fixed<8, 4>(1.5), 3).to_double(), 3);
  EXPECT_EQ(hls::min(ap_fixed<8, 4>(1.5), 3).to_double(), 1.5);
  EXPECT_EQ(hls::max(3, 4), 4);
  EXPECT_EQ(hls::abs(ap_int<8>(-128)).to_int(), -128);
  EXPECT_EQ(hls::abs(-7), 7);
  const ap_uint<16> both = 0x12ab;
  EXPECT_EQ(hls::max(both(7, 0), ap_uint<8>(1)).to_uint(), 0xabu);
}

// ---- hls::print, ap_wait ----
TEST(hls_print, prints_a_text_and_a_number) {
  testing::internal::CaptureStdout();
  hls::print("only text %\n");
  hls::print("%d and", ap_int<5>(-3).to_int());
  hls::print(" %.2f", 0.25f);
  ap_wait();
  ap_wait_n(3);
  ap_wait_until(true);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "only text %\n-3 and 0.25");
}

}  // namespace
