#pragma once
// Parameters that are arrays, for what calls a top: in hardware as natively. A function's array is a pointer to the
// compiler; how many elements there are is read from the text.

namespace hls::detail {

/// The number of elements in each parameter that is written as an array, or 0, by position.
template <int... Counts>
struct element_counts {
  static constexpr int at(int position) {
    const int counts[] = {Counts..., 0};
    return position < static_cast<int>(sizeof...(Counts)) ? counts[position] : 0;
  }
};

/// A parameter's type P as it is written, an array of `Count` elements; with 0 it is P.
template <class P, int Count>
struct as_written {
  using type = P;
};
template <class T, int Count>
struct as_written<T*, Count> {
  using type = T (&)[Count];
};
template <class T>
struct as_written<T*, 0> {
  using type = T*;
};

}  // namespace hls::detail
