#pragma once
// Balanced trees: log2(N) operations deep instead of N, and cut anywhere by pipeline registers.
#include <ap_int.h>

#include "window/bits.hpp"

namespace epiline::window {

/// 0, 1, 2 ... N-1 as values of their own. Compared with a loop's counter they cost nothing in hardware, and natively
/// they keep the lanes of a vector unit as narrow as the values they meet.
template <int N>
struct index_table {
  unsigned char of[N];
  constexpr index_table() : of{} {
    static_assert(N <= 256);
    for (int i = 0; i < N; ++i) of[i] = static_cast<unsigned char>(i);
  }
};
template <int N>
inline constexpr index_table<N> indices{};

/// Combines values[0 .. N-1]. `combine` must be associative and commutative: the halves of the array meet, element by
/// element, so every level of the tree is one loop over neighbours in memory.
template <int N, class Value, class Combine>
Value reduce(const Value (&values)[N], Combine combine) {
#pragma HLS INLINE
  if constexpr (N == 1) {
    return values[0];
  } else {
    constexpr int half = 1 << (bits_for(N - 1) - 1);  // the largest power of two below N
    Value reduced[half];
    for (int i = 0; i < N - half; ++i) reduced[i] = combine(values[i], values[i + half]);
    for (int i = N - half; i < half; ++i) reduced[i] = values[i];
    return reduce(reduced, combine);
  }
}

/// Tie-break policies of `minimum`: which of the places of the smallest value wins.
struct smallest_index_wins {
  static constexpr bool largest = false;
};
struct largest_index_wins {
  static constexpr bool largest = true;
};

template <class Value, class Index>
struct indexed {
  Value value;
  Index index;
};

/// The smallest of `keys`, with the bits of its place (inverted where the largest place wins) appended below.
/// The halves of the array meet, so every level of the tree decides the place's next lower bit: what is known of the
/// places is the lower part of the keys, of which one comparison decides, ties included. It grows with the level.
template <class Tie, int N, int Bits>
auto smallest_key(const ap_uint<Bits> (&keys)[N]) {
#pragma HLS INLINE
  if constexpr (N == 1) {
    return keys[0];
  } else {
    constexpr int half = 1 << (bits_for(N - 1) - 1);
    ap_uint<Bits + 1> reduced[half];
    for (int i = 0; i < N - half; ++i) {
      const ap_uint<Bits> a = keys[i];
      const ap_uint<Bits> b = keys[i + half];
      const bool second = Tie::largest ? !(a < b) : b < a;
      reduced[i] = (ap_uint<Bits + 1>(second ? b : a) << 1) | ap_uint<Bits + 1>(second != Tie::largest);
    }
    for (int i = N - half; i < half; ++i) {
      reduced[i] = (ap_uint<Bits + 1>(keys[i]) << 1) | ap_uint<Bits + 1>(Tie::largest);
    }
    return smallest_key<Tie>(reduced);
  }
}

/// The smallest of values[0 .. N-1] and where it stands.
template <class Tie, int N, int Bits>
auto minimum(const ap_uint<Bits> (&values)[N]) {
#pragma HLS INLINE
  constexpr int index_bits = bits_for(N - 1);
  using index_t = ap_uint<index_bits>;
  if constexpr (N == 1) {
    return indexed<ap_uint<Bits>, index_t>{values[0], index_t(0)};
  } else {
    const ap_uint<Bits + index_bits> smallest = smallest_key<Tie>(values);
    const index_t place = smallest;
    return indexed<ap_uint<Bits>, index_t>{ap_uint<Bits>(smallest >> index_bits),
                                           Tie::largest ? index_t(~place) : place};
  }
}

}  // namespace epiline::window
