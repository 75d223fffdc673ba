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
  static constexpr int rank(int index, int /*count*/) { return index; }
};
struct largest_index_wins {
  static constexpr int rank(int index, int count) { return count - 1 - index; }
};

template <class Value, class Index>
struct indexed {
  Value value;
  Index index;
};

/// The smallest of values[0 .. N-1] and where it stands. Value and rank of the place form one number, so a node of the
/// tree is one comparison, ties included.
template <class Tie, int N, int Bits>
auto minimum(const ap_uint<Bits> (&values)[N]) {
#pragma HLS INLINE
  constexpr int index_bits = bits_for(N - 1);
  using index_t = ap_uint<index_bits>;
  using key_t = ap_uint<Bits + index_bits>;
  key_t keys[N];
  for (int i = 0; i < N; ++i) {
    keys[i] = (key_t(values[i]) << index_bits) | key_t(Tie::rank(indices<N>.of[i], N));
  }
  const key_t smallest = reduce(keys, [](key_t a, key_t b) { return a < b ? a : b; });
  const index_t rank = smallest;
  return indexed<ap_uint<Bits>, index_t>{ap_uint<Bits>(smallest >> index_bits), index_t(Tie::rank(rank, N))};
}

}  // namespace epiline::window
