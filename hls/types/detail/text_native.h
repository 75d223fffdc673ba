#pragma once
// ap_int_base as text: part of ap_int.h, native builds only.

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
