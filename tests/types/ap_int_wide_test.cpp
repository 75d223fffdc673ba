// Random values of widths on both sides of every storage boundary, up to 2048 bits, against llvm::APInt. Built natively
// and for synthesis.

#include <ap_int.h>
#include <gtest/gtest.h>
#include <llvm/ADT/APInt.h>
#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/SmallString.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using llvm::APInt;

std::string text(const APInt& v) {
  llvm::SmallString<64> digits;
  v.toStringUnsigned(digits, 16);
  return std::string(digits.str());
}

// The bits of `v`, read word by word through shifts.
template <int W, bool S>
APInt bits_of(const ap_int_base<W, S>& v) {
  std::vector<std::uint64_t> words;
  for (int low = 0; low < W; low += 64) words.push_back((ap_uint<W>(v) >> low).to_uint64());
  return APInt(W, llvm::ArrayRef(words));
}

template <int W, bool S>
ap_int_base<W, S> from_bits(const APInt& v) {
  ap_uint<W> r = 0;
  for (int low = (W - 1) / 64 * 64; low >= 0; low -= 64) {
    r = (r << 64) | ap_uint<W>(v.lshr(static_cast<unsigned>(low)).getRawData()[0]);
  }
  return ap_int_base<W, S>(r);
}

APInt extended(const APInt& v, bool is_signed, int width) {
  const auto to = static_cast<unsigned>(width);
  return is_signed ? v.sextOrTrunc(to) : v.zextOrTrunc(to);
}

// Values whose carries, signs and lengths are worth trying, then plain random ones.
APInt next_value(std::mt19937_64& random, int width) {
  const auto w = static_cast<unsigned>(width);
  switch (random() % 8) {
    case 0:
      return APInt::getAllOnes(w);
    case 1:
      return APInt::getSignedMinValue(w);
    case 2:
      return APInt::getSignedMaxValue(w);
    case 3:
      return APInt(w, random() % 3);
    default:
      break;
  }
  std::vector<std::uint64_t> words((w + 63) / 64);
  for (auto& word : words) word = random();
  const APInt v(w, llvm::ArrayRef(words));
  return random() % 2 != 0 ? v : v.lshr(static_cast<unsigned>(random() % w));
}

// What a checker does that depends on no type: one EXPECT for every check in every instantiation would take minutes to
// compile.
class reporter {
 protected:
  explicit reporter(std::string types) : types_(std::move(types)) {}

  void compare(const char* operation, const APInt& actual, const APInt& expected) const {
    EXPECT_EQ(actual, expected) << text(a_) << " " << operation << " " << text(b_) << ": " << text(actual) << ", "
                                << types_;
  }
  void expect(const char* operation, long long actual, long long expected) const {
    EXPECT_EQ(actual, expected) << text(a_) << " " << operation << " " << text(b_) << ", " << types_;
  }

  APInt a_{1, 0};
  APInt b_{1, 0};

 private:
  std::string types_;
};

std::string type_name(int width, bool is_signed) {
  return (is_signed ? "ap_int<" : "ap_uint<") + std::to_string(width) + ">";
}

template <int W, bool S, int W2, bool S2>
class checker : reporter {
 public:
  checker() : reporter(type_name(W, S) + " and " + type_name(W2, S2)) {}

  void run(int repetitions) {
    std::mt19937_64 random(static_cast<std::uint64_t>(W * 131071 + W2 * 31 + S * 2 + S2));
    for (int i = 0; i < repetitions && !::testing::Test::HasFailure(); ++i) {
      a_ = next_value(random, W);
      b_ = next_value(random, W2);
      x_ = from_bits<W, S>(a_);
      y_ = from_bits<W2, S2>(b_);
      check_pair();
      check_left(static_cast<int>(random() % W), static_cast<int>(random() % W));
      check_shift(static_cast<int>(random() % (W + W / 2 + 2)));
    }
  }

 private:
  using reporter::expect;
  template <int R, bool RS>
  void expect(const char* operation, const ap_int_base<R, RS>& actual, const APInt& expected) const {
    compare(operation, bits_of(actual), extended(expected, true, R));
  }

  void check_pair() {
    // Wide enough for every exact result, signs included.
    constexpr int room = W + W2 + 2;
    const APInt a = extended(a_, S, room);
    const APInt b = extended(b_, S2, room);
    expect("+", x_ + y_, a + b);
    expect("-", x_ - y_, a - b);
    expect("*", x_ * y_, a * b);
    expect("&", x_ & y_, a & b);
    expect("|", x_ | y_, a | b);
    expect("^", x_ ^ y_, a ^ b);
    if (!b.isZero()) {
      expect("/", x_ / y_, a.sdiv(b));
      expect("%", x_ % y_, a.srem(b));
    }
    expect("==", x_ == y_, a == b);
    expect("!=", x_ != y_, a != b);
    expect("<", x_ < y_, a.slt(b));
    expect("<=", x_ <= y_, a.sle(b));
    expect(">", x_ > y_, a.sgt(b));
    expect(">=", x_ >= y_, a.sge(b));
    expect("converted", ap_int_base<W2, S2>(x_), a.trunc(W2));
    expect("concatenated", (x_, y_).get(), extended(a_, false, W + W2).shl(W2) | extended(b_, false, W + W2));
    auto z = x_;
    expect("+=", z += y_, (a + b).trunc(W));
    z = x_;
    expect("*=", z *= y_, (a * b).trunc(W));
    expect("-=", z -= y_, (a * b - b).trunc(W));
    ap_int_base<W, S> high;
    ap_int_base<W2, S2> low;
    (high, low) = (x_, y_);
    expect("distributed high", high, a_);
    expect("distributed low", low, b_);
  }

  void check_left(int i, int j) {
    expect("unary -", -x_, -extended(a_, S, W + 1));
    expect("~", ~x_, ~a_);
    expect("bool", static_cast<bool>(x_), !a_.isZero());
    expect("sign", x_.sign(), S && a_.isNegative());
    expect("to_int64", x_.to_int64(), static_cast<long long>(extended(a_, S, 64).getZExtValue()));
    expect("and_reduce", x_.and_reduce(), a_.isAllOnes());
    expect("xor_reduce", x_.xor_reduce(), a_.popcount() % 2 != 0);
    expect("countLeadingZeros", x_.countLeadingZeros(), static_cast<int>(a_.countl_zero()));
    const auto ui = static_cast<unsigned>(i);
    expect("[i]", x_[i], a_[ui]);
    auto z = x_;
    APInt flipped = a_;
    flipped.flipBit(ui);
    z[i] = !z[i];
    expect("[i] =", z, flipped);
    z = x_;
    expect("reverse", z.reverse(), a_.reverseBits());
    z = x_;
    expect("lrotate", z.lrotate(i), a_.rotl(ui));
    z = x_;
    expect("rrotate", z.rrotate(i), a_.rotr(ui));
    z = x_;
    expect("++", ++z, a_ + 1);
    z = x_;
    expect("--", --z, a_ - 1);

    const int high = i < j ? j : i;
    const auto low = static_cast<unsigned>(i < j ? i : j);
    const auto length = static_cast<unsigned>(high) - low + 1;
    const APInt field = a_.extractBits(length, low);
    expect("range", x_(high, static_cast<int>(low)).get(), extended(field, false, W));
    expect("range to 16 bits", ap_uint<16>(x_(high, static_cast<int>(low))), extended(field, false, 16));
    expect("range to 64 bits", ap_int<64>(x_(high, static_cast<int>(low))), extended(field, false, 64));
    expect("reversed range", x_(static_cast<int>(low), high).get(), extended(field.reverseBits(), false, W));
    APInt written = a_;
    written.insertBits(extended(b_, S2, static_cast<int>(length)), low);
    z = x_;
    z(high, static_cast<int>(low)) = y_;
    expect("range =", z, written);
  }

  void check_shift(int amount) {
    const bool out = amount >= W;
    const auto by = static_cast<unsigned>(out ? W - 1 : amount);
    const APInt right = S ? a_.ashr(by) : a_.lshr(by);
    const APInt all_out = S && a_.isNegative() ? APInt::getAllOnes(W) : APInt::getZero(W);
    const APInt shifted_left = out ? APInt::getZero(W) : a_.shl(by);
    const APInt shifted_right = out ? all_out : right;
    expect("<< int", x_ << amount, shifted_left);
    expect(">> int", x_ >> amount, shifted_right);
    expect("<< -int", x_ << -amount, shifted_right);
    expect(">> -int", x_ >> -amount, shifted_left);
    expect("<< ap_uint", x_ << ap_uint<12>(amount), shifted_left);
    expect(">> ap_uint", x_ >> ap_uint<100>(amount), shifted_right);
    expect("<< ap_int", x_ << ap_int<13>(-amount), shifted_right);
  }

  ap_int_base<W, S> x_;
  ap_int_base<W2, S2> y_;
};

template <int W, int W2>
void check_widths(int repetitions) {
  checker<W, false, W2, false>{}.run(repetitions);
  checker<W, false, W2, true>{}.run(repetitions);
  checker<W, true, W2, false>{}.run(repetitions);
  checker<W, true, W2, true>{}.run(repetitions);
}

TEST(ap_int_wide, thirty_three_bits) { check_widths<33, 31>(2000); }
TEST(ap_int_wide, one_word) { check_widths<64, 64>(2000); }
TEST(ap_int_wide, one_word_and_a_bit) { check_widths<65, 13>(2000); }
TEST(ap_int_wide, two_words) { check_widths<128, 100>(2000); }
TEST(ap_int_wide, two_words_and_a_bit) { check_widths<129, 65>(1000); }
TEST(ap_int_wide, narrow_with_wide) { check_widths<40, 300>(1000); }
TEST(ap_int_wide, two_thousand_bits) { check_widths<2048, 2047>(20); }

}  // namespace
