#pragma once
// Back end of ap_int.h for the synthesis build (clang with -D__SYNTHESIS__): every value is a `_BitInt` of its exact
// width, so that the LLVM IR consists of iN operations and nothing else. detail/integer_native.h is its twin and
// declares the same names; ap_int.h includes exactly one of them.

#include <cstddef>
#include <cstdint>
#include <type_traits>

#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wzero-length-array"
#pragma clang diagnostic ignored "-Wbit-int-extension"

namespace epiline::ap::backend {

// Two exceptions to the exact width. `_BitInt(1)` does not exist: values of ap_int<1> (0 and -1) are computed in two
// bits and stored in one. And above 64 bits, clang 19 keeps a _BitInt in memory as bytes, and returns it through a
// stack slot of just its bits, neither of which LLVM promotes to a value, unless its width is a multiple of 128: such
// values live in the next multiple, always sign- or zero-extended, and passes over known bits find the exact width
// again.
constexpr int container_bits(int width) { return width <= 64 ? width : (width + 127) / 128 * 128; }

template <int W, bool S>
struct raw_of {
  using type = unsigned _BitInt(container_bits(W));
};
template <int W>
struct raw_of<W, true> {
  using type = _BitInt(W == 1 ? 2 : container_bits(W));
};

/// The type values of ap_int_base<W, S> are computed in.
template <int W, bool S>
using raw = typename raw_of<W, S>::type;

/// `v` as a raw<W, S>; the caller knows that it fits.
template <int W, bool S, class R>
constexpr raw<W, S> convert(R v) {
  return static_cast<raw<W, S>>(v);
}

/// `v` modulo 2^W, as a raw<W, S>.
template <int W, bool S, class R>
constexpr raw<W, S> wrap(R v) {
  if constexpr (W == 1 && S) {
    return static_cast<raw<1, true>>(-static_cast<raw<2, true>>(static_cast<raw<1, false>>(v)));
  } else if constexpr (S) {
    return static_cast<raw<W, S>>(static_cast<_BitInt(W)>(v));
  } else {
    return static_cast<raw<W, S>>(static_cast<unsigned _BitInt(W)>(v));
  }
}

/// The low bits of `v` as the C integer T.
template <class T, class R>
constexpr T to_c(R v) {
  return static_cast<T>(v);
}

/// What an object of ap_int_base<W, S> holds. The zero-length array costs nothing and carries width and sign into the
/// LLVM type of every token: <{ iN, [0 x [W x i8]] }> if unsigned, <{ iN, [0 x [W x i16]] }> if signed, where iN is the
/// memory type of the value, wide enough for W bits. Packed: with an alignment of one byte, structs of such values
/// have no padding, which in an LLVM type would look like members.
template <int W, bool S>
struct storage {
  raw<W, false> value __attribute__((packed));
  std::conditional_t<S, short, char> width_tag[0][W] __attribute__((packed));
  storage() = default;
  constexpr explicit storage(raw<W, S> v) : value(wrap<W, false>(v)), width_tag{} {}
  constexpr raw<W, S> load() const { return wrap<W, S>(value); }
};

/// `v` with its W bits in reverse order.
template <int W>
constexpr raw<W, false> reverse_bits(raw<W, false> v) {
  if constexpr (W == 1) {
    return v;
  } else {
    return __builtin_elementwise_bitreverse(static_cast<unsigned _BitInt(W)>(v));
  }
}

/// Bit `index` of `v`, 0 <= index < W.
template <int W, bool S>
constexpr bool test_bit(raw<W, S> v, int index) {
  return static_cast<unsigned _BitInt(1)>(v >> index) != 0;
}

/// The 64 bits of `v` from bit `low` up, 0 <= low < W; above bit W - 1 they are unspecified.
template <int W, class R>
constexpr unsigned _BitInt(64) word_at(R v, int low) {
  return static_cast<unsigned _BitInt(64)>(v >> low);
}

// Errors are the native run's to report.
constexpr void check_bit_index(int, int) {}
constexpr void check_range(int, int, int) {}
constexpr void report_division_by_zero(int, bool, int, bool) {}

}  // namespace epiline::ap::backend

#pragma clang diagnostic pop
