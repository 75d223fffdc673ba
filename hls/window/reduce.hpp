#pragma once
// Balanced trees: log2(N) operations deep instead of N, and cut anywhere by pipeline registers.
#include <ap_int.h>

#include "window/bits.hpp"

namespace epiline::window {

/// Combines values[0 .. N-1] pairwise, neighbours first. `combine` must be associative; it need not be commutative.
template <int N, class Value, class Combine>
Value reduce(const Value (&values)[N], Combine combine) {
  if constexpr (N == 1) {
    return values[0];
  } else {
    Value half[(N + 1) / 2];
    for (int i = 0; i < N / 2; ++i) half[i] = combine(values[2 * i], values[2 * i + 1]);
    if constexpr (N % 2 != 0) half[N / 2] = values[N - 1];
    return reduce(half, combine);
  }
}

/// Tie-break policies of `minimum`: whether the right one of two neighbours, whose index is the larger, replaces the
/// left.
struct smallest_index_wins {
  template <class Value>
  static bool take_right(const Value& left, const Value& right) {
    return right < left;
  }
};
struct largest_index_wins {
  template <class Value>
  static bool take_right(const Value& left, const Value& right) {
    return !(left < right);
  }
};

template <class Value, class Index>
struct indexed {
  Value value;
  Index index;
};

/// The smallest of values[0 .. N-1] and where it stands. Values and indices are kept in arrays of their own, which is
/// how both the hardware and a vector unit want them.
template <class Tie, class Index, int N, class Value>
indexed<Value, Index> minimum_of(const Value (&values)[N], const Index (&indices)[N]) {
  if constexpr (N == 1) {
    return {values[0], indices[0]};
  } else {
    Value half_values[(N + 1) / 2];
    Index half_indices[(N + 1) / 2];
    for (int i = 0; i < N / 2; ++i) {
      const bool right = Tie::take_right(values[2 * i], values[2 * i + 1]);
      half_values[i] = right ? values[2 * i + 1] : values[2 * i];
      half_indices[i] = right ? indices[2 * i + 1] : indices[2 * i];
    }
    if constexpr (N % 2 != 0) {
      half_values[N / 2] = values[N - 1];
      half_indices[N / 2] = indices[N - 1];
    }
    return minimum_of<Tie, Index>(half_values, half_indices);
  }
}

template <class Tie, int N, class Value>
auto minimum(const Value (&values)[N]) {
  using index_t = ap_uint<bits_for(N - 1)>;
  index_t indices[N];
  for (int i = 0; i < N; ++i) indices[i] = i;
  return minimum_of<Tie, index_t>(values, indices);
}

}  // namespace epiline::window
