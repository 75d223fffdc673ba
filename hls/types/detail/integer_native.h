#pragma once
// Back end of ap_int.h for native builds: a value of W bits lives in the smallest built-in integer of its sign, always
// sign- or zero-extended, so that exact results need no masking and loops over arrays vectorise. Up to 128 bits this is
// a built-in type, above it `wide_integer`. detail/integer_synthesis.h is the twin and declares the same names;
// ap_int.h includes exactly one of them.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace epiline::ap::backend {

__extension__ typedef __int128 int128;
__extension__ typedef unsigned __int128 uint128;

/// Two's complement integer of N 64-bit words, least significant first; S decides how it extends, compares, divides and
/// shifts right. Arithmetic wraps modulo 2^(64 N).
template <int N, bool S>
class wide_integer {
 public:
  wide_integer() = default;

  template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
  constexpr explicit wide_integer(T v) : words_{} {
    const std::uint64_t fill = v < T{} ? ~std::uint64_t{0} : 0;
    words_[0] = static_cast<std::uint64_t>(v);
    for (int i = 1; i < N; ++i) words_[i] = fill;
  }
  constexpr explicit wide_integer(int128 v) : words_{} {
    words_[0] = static_cast<std::uint64_t>(v);
    const std::uint64_t high = static_cast<std::uint64_t>(v >> 64);
    for (int i = 1; i < N; ++i) words_[i] = i == 1 ? high : (v < 0 ? ~std::uint64_t{0} : 0);
  }
  constexpr explicit wide_integer(uint128 v) : words_{} {
    words_[0] = static_cast<std::uint64_t>(v);
    for (int i = 1; i < N; ++i) words_[i] = i == 1 ? static_cast<std::uint64_t>(v >> 64) : 0;
  }
  template <int N2, bool S2>
  constexpr explicit wide_integer(const wide_integer<N2, S2>& v) : words_{} {
    for (int i = 0; i < N; ++i) words_[i] = v.word(i);
  }

  template <class T, std::enable_if_t<std::is_integral_v<T>, int> = 0>
  constexpr explicit operator T() const {
    return static_cast<T>(words_[0]);
  }
  constexpr explicit operator uint128() const { return (static_cast<uint128>(word(1)) << 64) | words_[0]; }
  constexpr explicit operator int128() const { return static_cast<int128>(static_cast<uint128>(*this)); }

  /// Word i of the value's infinite extension.
  constexpr std::uint64_t word(int i) const { return i < N ? words_[i] : fill(); }
  constexpr void set_word(int i, std::uint64_t v) { words_[i] = v; }
  constexpr bool is_negative() const { return S && (words_[N - 1] >> 63) != 0; }

  friend constexpr wide_integer operator+(const wide_integer& a, const wide_integer& b) {
    wide_integer r{0};
    uint128 carry = 0;
    for (int i = 0; i < N; ++i) {
      carry += static_cast<uint128>(a.words_[i]) + b.words_[i];
      r.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }
  friend constexpr wide_integer operator-(const wide_integer& a) { return ~a + wide_integer{1}; }
  friend constexpr wide_integer operator-(const wide_integer& a, const wide_integer& b) { return a + -b; }
  friend constexpr wide_integer operator*(const wide_integer& a, const wide_integer& b) {
    wide_integer r{0};
    for (int i = 0; i < N; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; i + j < N; ++j) {
        const uint128 t = static_cast<uint128>(a.words_[i]) * b.words_[j] + r.words_[i + j] + carry;
        r.words_[i + j] = static_cast<std::uint64_t>(t);
        carry = static_cast<std::uint64_t>(t >> 64);
      }
    }
    return r;
  }
  friend constexpr wide_integer operator/(const wide_integer& a, const wide_integer& b) {
    const wide_integer q = divide_magnitudes(a, b).quotient;
    return a.is_negative() != b.is_negative() ? -q : q;
  }
  friend constexpr wide_integer operator%(const wide_integer& a, const wide_integer& b) {
    const wide_integer r = divide_magnitudes(a, b).remainder;
    return a.is_negative() ? -r : r;
  }
  friend constexpr wide_integer operator&(const wide_integer& a, const wide_integer& b) {
    wide_integer r{0};
    for (int i = 0; i < N; ++i) r.words_[i] = a.words_[i] & b.words_[i];
    return r;
  }
  friend constexpr wide_integer operator|(const wide_integer& a, const wide_integer& b) {
    wide_integer r{0};
    for (int i = 0; i < N; ++i) r.words_[i] = a.words_[i] | b.words_[i];
    return r;
  }
  friend constexpr wide_integer operator^(const wide_integer& a, const wide_integer& b) {
    wide_integer r{0};
    for (int i = 0; i < N; ++i) r.words_[i] = a.words_[i] ^ b.words_[i];
    return r;
  }
  friend constexpr wide_integer operator~(const wide_integer& a) {
    wide_integer r{0};
    for (int i = 0; i < N; ++i) r.words_[i] = ~a.words_[i];
    return r;
  }
  /// Shifts by 0 <= n < 64 N.
  friend constexpr wide_integer operator<<(const wide_integer& a, int n) {
    wide_integer r{0};
    const int whole = n / 64;
    const int part = n % 64;
    for (int i = N - 1; i >= whole; --i) {
      const std::uint64_t below = part != 0 && i > whole ? a.words_[i - whole - 1] >> (64 - part) : 0;
      r.words_[i] = (a.words_[i - whole] << part) | below;
    }
    return r;
  }
  friend constexpr wide_integer operator>>(const wide_integer& a, int n) {
    wide_integer r{0};
    const int whole = n / 64;
    const int part = n % 64;
    for (int i = 0; i < N; ++i) {
      const std::uint64_t above = part != 0 ? a.word(i + whole + 1) << (64 - part) : 0;
      r.words_[i] = (a.word(i + whole) >> part) | above;
    }
    return r;
  }
  friend constexpr bool operator==(const wide_integer& a, const wide_integer& b) {
    for (int i = 0; i < N; ++i) {
      if (a.words_[i] != b.words_[i]) return false;
    }
    return true;
  }
  friend constexpr bool operator<(const wide_integer& a, const wide_integer& b) {
    if (a.is_negative() != b.is_negative()) return a.is_negative();
    return less_as_unsigned(a, b);
  }

 private:
  struct division {
    wide_integer quotient;
    wide_integer remainder;
  };

  constexpr std::uint64_t fill() const { return is_negative() ? ~std::uint64_t{0} : 0; }
  static constexpr bool less_as_unsigned(const wide_integer& a, const wide_integer& b) {
    for (int i = N - 1; i >= 0; --i) {
      if (a.words_[i] != b.words_[i]) return a.words_[i] < b.words_[i];
    }
    return false;
  }
  // Restoring division, one bit a step: wide quotients are rare in streaming kernels, simple beats fast. b is not 0.
  static constexpr division divide_magnitudes(const wide_integer& a, const wide_integer& b) {
    const wide_integer dividend = a.is_negative() ? -a : a;
    const wide_integer divisor = b.is_negative() ? -b : b;
    division d{wide_integer{0}, wide_integer{0}};
    for (int i = 64 * N - 1; i >= 0; --i) {
      const bool carry = (d.remainder.words_[N - 1] >> 63) != 0;
      d.remainder = d.remainder << 1;
      d.remainder.words_[0] |= (dividend.words_[i / 64] >> (i % 64)) & 1;
      if (carry || !less_as_unsigned(d.remainder, divisor)) {
        d.remainder = d.remainder - divisor;
        d.quotient.words_[i / 64] |= std::uint64_t{1} << (i % 64);
      }
    }
    return d;
  }

  std::uint64_t words_[N];
};

template <int N, bool S>
constexpr bool operator!=(const wide_integer<N, S>& a, const wide_integer<N, S>& b) {
  return !(a == b);
}
template <int N, bool S>
constexpr bool operator>(const wide_integer<N, S>& a, const wide_integer<N, S>& b) {
  return b < a;
}
template <int N, bool S>
constexpr bool operator<=(const wide_integer<N, S>& a, const wide_integer<N, S>& b) {
  return !(b < a);
}
template <int N, bool S>
constexpr bool operator>=(const wide_integer<N, S>& a, const wide_integer<N, S>& b) {
  return !(a < b);
}

template <bool S, class Signed, class Unsigned>
using by_sign = std::conditional_t<S, Signed, Unsigned>;

template <int W, bool S>
constexpr auto raw_probe() {
  if constexpr (W <= 8) {
    return by_sign<S, std::int8_t, std::uint8_t>{};
  } else if constexpr (W <= 16) {
    return by_sign<S, std::int16_t, std::uint16_t>{};
  } else if constexpr (W <= 32) {
    return by_sign<S, std::int32_t, std::uint32_t>{};
  } else if constexpr (W <= 64) {
    return by_sign<S, std::int64_t, std::uint64_t>{};
  } else if constexpr (W <= 128) {
    return by_sign<S, int128, uint128>{};
  } else {
    return wide_integer<(W + 63) / 64, S>{0};
  }
}

/// The type values of ap_int_base<W, S> are computed in.
template <int W, bool S>
using raw = decltype(raw_probe<W, S>());

/// `v` as a raw<W, S>; the caller knows that it fits.
template <int W, bool S, class R>
constexpr raw<W, S> convert(const R& v) {
  return static_cast<raw<W, S>>(v);
}

/// `v` modulo 2^W, as a raw<W, S>.
template <int W, bool S, class R>
constexpr raw<W, S> wrap(const R& v) {
  if constexpr (W <= 128) {
    using bits = raw<W, false>;
    constexpr int unused = static_cast<int>(8 * sizeof(bits)) - W;
    const bits low = static_cast<bits>(v);
    if constexpr (unused == 0) {
      return static_cast<raw<W, S>>(low);
    } else if constexpr (S) {
      return static_cast<raw<W, S>>(static_cast<raw<W, S>>(low << unused) >> unused);
    } else {
      return static_cast<bits>(low & (static_cast<bits>(~bits{}) >> unused));
    }
  } else {
    raw<W, S> r(v);
    if constexpr (W % 64 != 0) {
      constexpr int top = W / 64;
      r.set_word(top, static_cast<std::uint64_t>(wrap<W % 64, S>(r.word(top))));
    }
    return r;
  }
}

/// The low bits of `v` as the C integer T.
template <class T, class R>
constexpr T to_c(const R& v) {
  return static_cast<T>(v);
}

/// What an object of ap_int_base<W, S> holds.
template <int W, bool S>
struct storage {
  raw<W, S> value;
  storage() = default;
  constexpr explicit storage(const raw<W, S>& v) : value(v) {}
  constexpr const raw<W, S>& load() const { return value; }
};

/// `v` with its W bits in reverse order.
template <int W>
constexpr raw<W, false> reverse_bits(const raw<W, false>& v) {
  if constexpr (W <= 64) {
    std::uint64_t r = v;
    r = ((r >> 1) & 0x5555555555555555u) | ((r & 0x5555555555555555u) << 1);
    r = ((r >> 2) & 0x3333333333333333u) | ((r & 0x3333333333333333u) << 2);
    r = ((r >> 4) & 0x0f0f0f0f0f0f0f0fu) | ((r & 0x0f0f0f0f0f0f0f0fu) << 4);
    r = ((r >> 8) & 0x00ff00ff00ff00ffu) | ((r & 0x00ff00ff00ff00ffu) << 8);
    r = ((r >> 16) & 0x0000ffff0000ffffu) | ((r & 0x0000ffff0000ffffu) << 16);
    r = (r >> 32) | (r << 32);
    return static_cast<raw<W, false>>(r >> (64 - W));
  } else {
    constexpr int words = (W + 63) / 64;
    const wide_integer<words, false> in(v);
    wide_integer<words, false> out(0);
    for (int i = 0; i < words; ++i) out.set_word(words - 1 - i, reverse_bits<64>(in.word(i)));
    return static_cast<raw<W, false>>(out >> (64 * words - W));
  }
}

/// Bit `index` of `v`, 0 <= index < W.
template <int W, bool S>
constexpr bool test_bit(const raw<W, S>& v, int index) {
  if constexpr (W <= 128) {
    return ((v >> index) & 1) != 0;
  } else {
    return ((v.word(index / 64) >> (index % 64)) & 1) != 0;
  }
}

/// The 64 bits of `v` from bit `low` up, 0 <= low < W; above bit W - 1 they are unspecified.
template <int W, class R>
constexpr std::uint64_t word_at(const R& v, int low) {
  if constexpr (W <= 128) {
    return static_cast<std::uint64_t>(v >> low);
  } else {
    const int part = low % 64;
    const std::uint64_t above = part != 0 ? v.word(low / 64 + 1) << (64 - part) : 0;
    return (v.word(low / 64) >> part) | above;
  }
}

// Errors of a program run natively: they are bugs of the kernel, so the run stops where they are found.

[[noreturn]] inline void fail_bit_index(int index, int width) {
  std::fprintf(stderr, "ap_int: bit index %d is outside a value of %d bits (0..%d)\n", index, width, width - 1);
  std::abort();
}
[[noreturn]] inline void fail_range(int high, int low, int width) {
  std::fprintf(stderr, "ap_int: range(%d, %d) is outside a value of %d bits (0..%d)\n", high, low, width, width - 1);
  std::abort();
}
constexpr void check_bit_index(int index, int width) {
  if (index < 0 || index >= width) fail_bit_index(index, width);
}
constexpr void check_range(int high, int low, int width) {
  if (high < 0 || low < 0 || high >= width || low >= width) fail_range(high, low, width);
}
/// Division by zero has a result (see ap_int.h), so the run goes on; every occurrence is reported.
inline void report_division_by_zero(int width, bool is_signed, int divisor_width, bool divisor_signed) {
  std::fprintf(stderr,
               "ap_int: division of ap_%s<%d> by an ap_%s<%d> that is zero: quotient all ones, remainder dividend\n",
               is_signed ? "int" : "uint", width, divisor_signed ? "int" : "uint", divisor_width);
}

}  // namespace epiline::ap::backend
