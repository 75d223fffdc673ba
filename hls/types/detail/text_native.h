#pragma once
// Text and floating point of ap_int_base: part of ap_int.h, native builds only.

namespace epiline::ap {

template <int W, bool S>
std::string ap_int_base<W, S>::to_string(int radix, bool sign) const {
  if (radix != 2 && radix != 8 && radix != 10 && radix != 16) {
    throw std::invalid_argument("ap_int: to_string() knows radix 2, 8, 10 and 16, not " + std::to_string(radix));
  }
  const bool minus = radix != 2 && sign && this->sign();
  ap_int_base<W, false> rest(*this);
  if (minus) rest = -*this;
  std::string digits;
  if (radix == 10) {
    const ap_int_base<4, false> ten(10);
    do {
      digits.insert(digits.begin(), static_cast<char>('0' + (rest % ten).to_int()));
      rest = rest / ten;
    } while (!rest.is_zero());
  } else {
    const int digit_bits = radix == 2 ? 1 : radix == 8 ? 3 : 4;
    do {
      digits.insert(digits.begin(), "0123456789abcdef"[(rest & ap_int_base<8, false>(radix - 1)).to_int()]);
      rest >>= digit_bits;
    } while (!rest.is_zero());
  }
  const char* prefix = radix == 2 ? "0b" : radix == 8 ? "0o" : radix == 16 ? "0x" : "";
  return (minus ? "-" : "") + (prefix + digits);
}

template <int W, bool S>
double ap_int_base<W, S>::to_double() const {
  // Through sixteen-bit digits, exact in long double as long as the value has at most 64 bits.
  ap_int_base<W, false> rest(*this);
  if (sign()) rest = -*this;
  long double value = 0;
  for (int low = (W - 1) / 16 * 16; low >= 0; low -= 16) {
    value = value * 65536 + static_cast<long double>(((rest >> low) & ap_int_base<16, false>(0xffff)).to_int());
  }
  return static_cast<double>(sign() ? -value : value);
}

template <int W, bool S>
ap_int_base<W, S> ap_int_base<W, S>::from_floating(long double v) {
  if (!std::isfinite(v)) throw std::invalid_argument("ap_int: NaN and infinities have no integer value");
  int exponent = 0;
  // |v| = mantissa * 2^exponent with a 64-bit integer mantissa
  const long double mantissa = std::ldexp(std::frexp(std::fabs(v), &exponent), 64);
  exponent -= 64;
  const auto bits = static_cast<std::uint64_t>(mantissa);
  // A negative amount shifts right, which truncates the magnitude toward zero.
  const ap_int_base<(W > 64 ? W : 64), false> magnitude = ap_int_base<(W > 64 ? W : 64), false>(bits) << exponent;
  return v < 0 ? ap_int_base(-magnitude) : ap_int_base(magnitude);
}

template <int W, bool S>
ap_int_base<W, S> ap_int_base<W, S>::from_string(const char* text, int radix) {
  const auto fail = [text](const char* why) {
    throw std::invalid_argument("ap_int: \"" + std::string(text) + "\": " + why);
  };
  const char* p = text;
  const bool minus = *p == '-';
  if (*p == '-' || *p == '+') ++p;
  int prefix_radix = 0;
  if (*p == '0' && p[1] != '\0') {
    const char letter = p[1];
    prefix_radix = letter == 'x' || letter == 'X' ? 16 : letter == 'o' || letter == 'O' ? 8 : 0;
    // In radix 16, "0b1" are three digits.
    if (radix != 16 && (letter == 'b' || letter == 'B')) prefix_radix = 2;
  }
  if (prefix_radix != 0) {
    if (radix != 0 && radix != prefix_radix) fail("the prefix contradicts the radix");
    radix = prefix_radix;
    p += 2;
  }
  if (radix == 0) radix = 10;
  if (radix != 2 && radix != 8 && radix != 10 && radix != 16) fail("the radix must be 2, 8, 10 or 16");
  if (*p == '\0') fail("there are no digits");
  ap_int_base<W, false> value(false);
  for (; *p != '\0'; ++p) {
    int digit = 99;
    if (*p >= '0' && *p <= '9') digit = *p - '0';
    if (*p >= 'a' && *p <= 'f') digit = *p - 'a' + 10;
    if (*p >= 'A' && *p <= 'F') digit = *p - 'A' + 10;
    if (digit >= radix) fail("not a digit of its radix");
    value = value * ap_int_base<5, false>(radix) + ap_int_base<4, false>(digit);
  }
  return minus ? ap_int_base(-value) : ap_int_base(value);
}

/// Decimal unless the stream says std::hex or std::oct (then as to_string() writes it).
template <class A, std::enable_if_t<detail::is_ap<A>, int> = 0>
std::ostream& operator<<(std::ostream& out, const A& a) {
  const auto& v = detail::value_of(a);
  const auto base = out.flags() & std::ios_base::basefield;
  return out << v.to_string(base == std::ios_base::hex ? 16 : base == std::ios_base::oct ? 8 : 10);
}

/// Reads one word in the stream's radix or with a prefix; a word that is no number sets failbit.
template <int W, bool S>
std::istream& operator>>(std::istream& in, ap_int_base<W, S>& v) {
  std::string word;
  if (!(in >> word)) return in;
  const auto base = in.flags() & std::ios_base::basefield;
  try {
    v = ap_int_base<W, S>(word, base == std::ios_base::hex ? 16 : base == std::ios_base::oct ? 8 : 0);
  } catch (const std::invalid_argument&) {
    in.setstate(std::ios_base::failbit);
  }
  return in;
}

}  // namespace epiline::ap
