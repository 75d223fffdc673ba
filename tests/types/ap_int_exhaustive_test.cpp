// Every operator, for every value of every pair of types up to six bits, against plain 64-bit arithmetic. This file is
// built natively and for synthesis: both builds are held to the same reference.

#include <ap_int.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace {

constexpr int max_width = 6;

template <int W, bool S>
constexpr long long smallest = S ? -(1LL << (W - 1)) : 0;
template <int W, bool S>
constexpr long long largest = S ? (1LL << (W - 1)) - 1 : (1LL << W) - 1;

// `v` modulo 2^width, as a number of the given sign.
constexpr long long wrap(long long v, int width, bool is_signed) {
  const long long low = v & ((1LL << width) - 1);
  return is_signed && ((low >> (width - 1)) & 1) != 0 ? low - (1LL << width) : low;
}

constexpr long long shifted_left(long long v, long long amount, int width, bool is_signed) {
  if (amount >= width) return 0;
  if (amount <= -width) return v < 0 ? -1 : 0;
  return wrap(amount >= 0 ? v * (1LL << amount) : v >> -amount, width, is_signed);
}

// Remembers the first mismatch: one EXPECT for each of millions of comparisons would dominate the run time.
class mismatch {
 public:
  void check(const char* operation, long long a, long long b, long long actual, long long expected) {
    if (actual == expected) return;
    if (count_++ == 0) {
      first_ = std::to_string(a) + " " + operation + " " + std::to_string(b) + " = " + std::to_string(actual) +
               ", expected " + std::to_string(expected);
    }
  }
  int count() const { return count_; }
  const std::string& first() const { return first_; }

 private:
  int count_ = 0;
  std::string first_;
};

template <class T>
constexpr int width_of = T::width;
template <class T>
constexpr bool sign_of = T::is_signed;

template <class T>
long long number(const T& v) {
  return v.to_int64();
}

template <class Left, class Right>
void check_pair(mismatch& errors) {
  constexpr int w = width_of<Left>, w2 = width_of<Right>;
  constexpr bool s = sign_of<Left>, s2 = sign_of<Right>;
  for (long long a = smallest<w, s>; a <= largest<w, s>; ++a) {
    for (long long b = smallest<w2, s2>; b <= largest<w2, s2>; ++b) {
      const Left x = a;
      const Right y = b;
      const auto check = [&](const char* operation, long long actual, long long expected) {
        errors.check(operation, a, b, actual, expected);
      };
      const auto check_assign = [&](const char* operation, const Left& actual, long long expected) {
        errors.check(operation, a, b, number(actual), wrap(expected, w, s));
      };
      check("+", number(x + y), a + b);
      check("-", number(x - y), a - b);
      check("*", number(x * y), a * b);
      check("&", number(x & y), wrap(a & b, width_of<decltype(x & y)>, s || s2));
      check("|", number(x | y), wrap(a | b, width_of<decltype(x | y)>, s || s2));
      check("^", number(x ^ y), wrap(a ^ b, width_of<decltype(x ^ y)>, s || s2));
      if (b != 0) {
        check("/", number(x / y), a / b);
        check("%", number(x % y), a % b);
      }
      check("<<", number(x << y), shifted_left(a, b, w, s));
      check(">>", number(x >> y), shifted_left(a, -b, w, s));
      check("==", x == y, a == b);
      check("!=", x != y, a != b);
      check("<", x < y, a < b);
      check("<=", x <= y, a <= b);
      check(">", x > y, a > b);
      check(">=", x >= y, a >= b);
      check("concat", number((x, y)), (wrap(a, w, false) << w2) | wrap(b, w2, false));
      check("conversion", number(Right(x)), wrap(a, w2, s2));
      Left z;
      z = x, check_assign("+=", z += y, a + b);
      z = x, check_assign("-=", z -= y, a - b);
      z = x, check_assign("*=", z *= y, a * b);
      z = x, check_assign("&=", z &= y, a & b);
      z = x, check_assign("|=", z |= y, a | b);
      z = x, check_assign("^=", z ^= y, a ^ b);
      if (b != 0) {
        z = x, check_assign("/=", z /= y, a / b);
        z = x, check_assign("%=", z %= y, a % b);
      }
      z = x, check_assign("<<=", z <<= y, shifted_left(a, b, w, s));
      z = x, check_assign(">>=", z >>= y, shifted_left(a, -b, w, s));
      z = y, check_assign("=", z, b);
      Left high;
      Right low;
      (high, low) = ap_uint<w + w2>((x, y));
      check("distribution, high", number(high), a);
      check("distribution, low", number(low), b);
    }
  }
}

// With a C integer the operand is as wide as the C type.
template <class Left, class C>
void check_with_c(mismatch& errors) {
  constexpr int w = width_of<Left>;
  constexpr bool s = sign_of<Left>;
  for (long long a = smallest<w, s>; a <= largest<w, s>; ++a) {
    for (long long value = -70; value <= 70; ++value) {
      const C c = static_cast<C>(value);
      const long long b = static_cast<long long>(c);
      if (b != value || (value < 0 && !std::is_signed_v<C>)) continue;  // not a value of C
      const Left x = a;
      const auto check = [&](const char* operation, long long actual, long long expected) {
        errors.check(operation, a, b, actual, expected);
      };
      check("+ C", number(x + c), a + b);
      check("C +", number(c + x), b + a);
      check("- C", number(x - c), a - b);
      check("C -", number(c - x), b - a);
      check("* C", number(x * c), a * b);
      check("C *", number(c * x), b * a);
      check("== C", x == c, a == b);
      check("C ==", c == x, a == b);
      check("< C", x < c, a < b);
      check("C <", c < x, b < a);
      check(">= C", x >= c, a >= b);
      check("C >=", c >= x, b >= a);
      check("<< C", number(x << c), shifted_left(a, b, w, s));
      check(">> C", number(x >> c), shifted_left(a, -b, w, s));
      check("& C", number(x & c), a & b);
      check("C |", number(c | x), a | b);
      check("^ C", number(x ^ c), a ^ b);
      if (b != 0) {
        check("/ C", number(x / c), a / b);
        check("% C", number(x % c), a % b);
      }
      if (a != 0) {
        check("C /", number(c / x), b / a);
        check("C %", number(c % x), b % a);
      }
      Left z = x;
      check("+= C", number(z += c), wrap(a + b, w, s));
      z = c;
      check("= C", number(z), wrap(b, w, s));
    }
  }
}

template <class T>
void check_alone(mismatch& errors) {
  constexpr int w = width_of<T>;
  constexpr bool s = sign_of<T>;
  for (long long a = smallest<w, s>; a <= largest<w, s>; ++a) {
    const T x = a;
    const long long pattern = wrap(a, w, false);
    const auto check = [&](const char* operation, long long actual, long long expected) {
      errors.check(operation, a, 0, actual, expected);
    };
    check("unary -", number(-x), -a);
    check("unary +", number(+x), a);
    check("~", number(~x), wrap(~a, w, s));
    check("!", !x, a == 0);
    check("bool", x ? 1 : 0, a != 0);
    check("int", static_cast<int>(x), a);
    T z = x;
    check("++x", number(++z), wrap(a + 1, w, s));
    check("x++", number(z++), wrap(a + 1, w, s));
    check("after x++", number(z), wrap(a + 2, w, s));
    z = x;
    check("--x", number(--z), wrap(a - 1, w, s));
    check("x--", number(z--), wrap(a - 1, w, s));
    check("after x--", number(z), wrap(a - 2, w, s));
    check("sign", x.sign(), a < 0);
    int ones = 0;
    long long reversed = 0;
    for (int i = 0; i < w; ++i) {
      const long long bit = (pattern >> i) & 1;
      ones += static_cast<int>(bit);
      reversed |= bit << (w - 1 - i);
      check("[i]", x[i], bit);
      check("test", x.test(i), bit);
      for (int value = 0; value <= 1; ++value) {
        z = x;
        z[i] = value;
        const long long expected = wrap((pattern & ~(1LL << i)) | (static_cast<long long>(value) << i), w, s);
        check("[i] =", number(z), expected);
        z = x;
        z.set(i, value != 0);
        check("set", number(z), expected);
      }
      z = x;
      z.invert(i);
      check("invert", number(z), wrap(pattern ^ (1LL << i), w, s));
      z = x;
      check("lrotate", number(z.lrotate(i)), wrap((pattern << i) | (pattern >> (w - i)), w, s));
      z = x;
      check("rrotate", number(z.rrotate(i)), wrap((pattern >> i) | (pattern << (w - i)), w, s));
    }
    z = x;
    check("reverse", number(z.reverse()), wrap(reversed, w, s));
    check("and_reduce", x.and_reduce(), ones == w);
    check("nand_reduce", x.nand_reduce(), ones != w);
    check("or_reduce", x.or_reduce(), ones != 0);
    check("nor_reduce", x.nor_reduce(), ones == 0);
    check("xor_reduce", x.xor_reduce(), ones % 2);
    check("xnor_reduce", x.xnor_reduce(), 1 - ones % 2);
    int zeros = 0;
    while (zeros < w && ((pattern >> (w - 1 - zeros)) & 1) == 0) ++zeros;
    check("countLeadingZeros", x.countLeadingZeros(), zeros);
    for (int high = 0; high < w; ++high) {
      for (int low = 0; low < w; ++low) {
        const bool turned = high < low;
        const int bottom = turned ? high : low;
        const int length = (turned ? low - high : high - low) + 1;
        const long long mask = (1LL << length) - 1;
        long long field = (pattern >> bottom) & mask;
        if (turned) {
          long long in_order = 0;
          for (int i = 0; i < length; ++i) in_order |= ((field >> i) & 1) << (length - 1 - i);
          field = in_order;
        }
        check("range", number(x.range(high, low).get()), field);
        check("(high, low)", static_cast<long long>(x(high, low)), field);
        check("range length", x(high, low).length(), length);
        check("range as operand", number(x(high, low) + 1), field + 1);
        // Writing is the inverse of reading: the low bits of the source land where a read finds them.
        for (const long long source : {0LL, -1LL, 0x2aLL, 0x16LL}) {
          z = x;
          z(high, low) = source;
          check("range after writing", number(z(high, low).get()), source & mask);
          check("rest after writing", wrap(number(z), w, false) & ~(mask << bottom), pattern & ~(mask << bottom));
        }
      }
    }
  }
}

template <int W>
using width_constant = std::integral_constant<int, W>;

// Calls f(width_constant<1>), ..., f(width_constant<max_width>).
template <class F, int... W>
void for_each_width(F f, std::integer_sequence<int, W...>) {
  (f(width_constant<W + 1>{}), ...);
}
template <class F>
void for_each_width(F f) {
  for_each_width(f, std::make_integer_sequence<int, max_width>{});
}

template <bool S, bool S2>
void check_pairs() {
  for_each_width([](auto left) {
    for_each_width([left](auto right) {
      mismatch errors;
      check_pair<ap_int_base<decltype(left)::value, S>, ap_int_base<decltype(right)::value, S2>>(errors);
      EXPECT_EQ(errors.count(), 0) << "widths " << left() << ", " << right() << ": " << errors.first();
    });
  });
}

template <bool S>
void check_c_integers() {
  for_each_width([](auto width) {
    using value = ap_int_base<decltype(width)::value, S>;
    mismatch errors;
    check_with_c<value, bool>(errors);
    check_with_c<value, char>(errors);
    check_with_c<value, signed char>(errors);
    check_with_c<value, unsigned char>(errors);
    check_with_c<value, short>(errors);
    check_with_c<value, unsigned short>(errors);
    check_with_c<value, int>(errors);
    check_with_c<value, unsigned>(errors);
    check_with_c<value, long>(errors);
    check_with_c<value, unsigned long>(errors);
    check_with_c<value, long long>(errors);
    check_with_c<value, unsigned long long>(errors);
    EXPECT_EQ(errors.count(), 0) << "width " << width() << ": " << errors.first();
  });
}

template <bool S>
void check_single() {
  for_each_width([](auto width) {
    mismatch errors;
    check_alone<ap_int_base<decltype(width)::value, S>>(errors);
    EXPECT_EQ(errors.count(), 0) << "width " << width() << ": " << errors.first();
  });
}

TEST(ap_int_exhaustive, unsigned_with_unsigned) { check_pairs<false, false>(); }
TEST(ap_int_exhaustive, unsigned_with_signed) { check_pairs<false, true>(); }
TEST(ap_int_exhaustive, signed_with_unsigned) { check_pairs<true, false>(); }
TEST(ap_int_exhaustive, signed_with_signed) { check_pairs<true, true>(); }
TEST(ap_int_exhaustive, unsigned_with_c_integers) { check_c_integers<false>(); }
TEST(ap_int_exhaustive, signed_with_c_integers) { check_c_integers<true>(); }
TEST(ap_int_exhaustive, unsigned_alone) { check_single<false>(); }
TEST(ap_int_exhaustive, signed_alone) { check_single<true>(); }

}  // namespace
