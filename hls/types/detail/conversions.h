#pragma once
// ap_int_base of text and of floating point, and back to floating point: part of ap_int.h. Hardware has neither: there
// it is computed when the source is compiled, of constants.

#ifdef __SYNTHESIS__
extern "C" [[noreturn]] void __epiline_no_number() noexcept;
#endif

namespace epiline::ap {

namespace detail {

[[noreturn]] inline void no_number(const char* what, const char* why) {
#ifdef __SYNTHESIS__
  (void)what;
  (void)why;
  __epiline_no_number();  // refused
#else
  throw std::invalid_argument("ap_int: \"" + std::string(what) + "\": " + why);
#endif
}

}  // namespace detail

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
template <class T>
ap_int_base<W, S> ap_int_base<W, S>::from_floating(T v) {
  if constexpr (sizeof(T) > sizeof(double)) {
    // Two parts that a double holds.
    const T whole = __builtin_truncl(v);
    const auto high = static_cast<double>(whole);
    if (high - high != 0) detail::no_number("NaN or an infinity", "has no integer value");
    return ap_int_base(from_floating(high) + from_floating(static_cast<double>(whole - high)));
  } else {
    const auto bits = __builtin_bit_cast(unsigned long long, static_cast<double>(v));
    const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
    if (exponent == 0x7ff) detail::no_number("NaN or an infinity", "has no integer value");
    // |v| = mantissa * 2^places; what is less than the smallest normal number has no integer part
    const unsigned long long mantissa = exponent == 0 ? 0 : bits << 12 >> 12 | 1ull << 52;
    const int places = exponent - 1075;
    // A negative amount shifts right, which truncates the magnitude toward zero.
    const ap_int_base<(W > 64 ? W : 64), false> magnitude = ap_int_base<(W > 64 ? W : 64), false>(mantissa) << places;
    return bits >> 63 != 0 ? ap_int_base(-magnitude) : ap_int_base(magnitude);
  }
}

template <int W, bool S>
ap_int_base<W, S> ap_int_base<W, S>::from_string(const char* text, int radix) {
  int at = 0;
  const bool minus = text[at] == '-';
  if (text[at] == '-' || text[at] == '+') ++at;
  int prefix_radix = 0;
  if (text[at] == '0' && text[at + 1] != '\0') {
    const char letter = text[at + 1];
    prefix_radix = letter == 'x' || letter == 'X' ? 16 : letter == 'o' || letter == 'O' ? 8 : 0;
    // In radix 16, "0b1" are three digits.
    if (radix != 16 && (letter == 'b' || letter == 'B')) prefix_radix = 2;
  }
  if (prefix_radix != 0) {
    if (radix != 0 && radix != prefix_radix) detail::no_number(text, "the prefix contradicts the radix");
    radix = prefix_radix;
    at += 2;
  }
  if (radix == 0) radix = 10;
  if (radix != 2 && radix != 8 && radix != 10 && radix != 16)
    detail::no_number(text, "the radix must be 2, 8, 10 or 16");
  if (text[at] == '\0') detail::no_number(text, "there are no digits");
  ap_int_base<W, false> value(false);
  for (; text[at] != '\0'; ++at) {
    const char letter = text[at];
    int digit = 99;
    if (letter >= '0' && letter <= '9') digit = letter - '0';
    if (letter >= 'a' && letter <= 'f') digit = letter - 'a' + 10;
    if (letter >= 'A' && letter <= 'F') digit = letter - 'A' + 10;
    if (digit >= radix) detail::no_number(text, "not a digit of its radix");
    value = value * ap_int_base<5, false>(radix) + ap_int_base<4, false>(digit);
  }
  return minus ? ap_int_base(-value) : ap_int_base(value);
}

}  // namespace epiline::ap
