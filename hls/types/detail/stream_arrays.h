#pragma once
// Parameters that are arrays, for what calls a top: in hardware as natively. A function's array is a pointer to the
// compiler; how many elements there are is read from the text.

#include <hls_stream.h>

#include <type_traits>

namespace hls::detail {

/// A longer array is data, which comes and goes element by element; a shorter one is one value.
inline constexpr unsigned long most_array_bytes = 128;

template <class T>
inline constexpr bool is_stream = false;
template <class T, int Depth>
inline constexpr bool is_stream<hls::stream<T, Depth>> = true;

/// In place of the parameter: an array A that is data.
template <class A>
struct data_of;

/// An array's reference, or data_of where it is data: by its size or, `IsStream`, since the source says so.
template <class A, bool IsStream = false>
struct value_or_data {
  using element = std::remove_cv_t<std::remove_all_extents_t<A>>;
  static constexpr bool is_data =
      (IsStream || sizeof(A) > most_array_bytes) && !is_stream<element> && !std::is_pointer_v<element>;
  using type = std::conditional_t<is_data, data_of<A>, A&>;
};

/// The number of elements in each parameter that is written as an array, or 0, by position; negative: it is data,
/// whatever its size.
template <int... Counts>
struct element_counts {
  static constexpr int at(int position) {
    const int counts[] = {Counts..., 0};
    return position < static_cast<int>(sizeof...(Counts)) ? counts[position] : 0;
  }
};

/// A parameter's type P as it is written, an array of `Count` elements or data_of it; with 0 it is P.
template <class P, int Count>
struct as_written {
  using type = P;
};
template <class T, int Count>
struct as_written<T*, Count> : value_or_data<T[Count < 0 ? -Count : Count], (Count < 0)> {};
template <class T>
struct as_written<T*, 0> {
  using type = T*;
};
template <class T, decltype(sizeof(0)) Size, int Count>
struct as_written<T (&)[Size], Count> : value_or_data<T[Size]> {};

}  // namespace hls::detail
