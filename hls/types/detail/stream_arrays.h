#pragma once
// Parameters that are arrays of streams, for what calls a top: in hardware as natively. A function's array of streams
// is a pointer to the compiler; how many there are is read from the text.

#include <type_traits>

#include "../hls_stream.h"

namespace hls::detail {

/// The number of streams in each parameter that is written as an array of them, or 0, by position.
template <int... Counts>
struct stream_counts {
  static constexpr int at(int position) {
    const int counts[] = {Counts..., 0};
    return position < static_cast<int>(sizeof...(Counts)) ? counts[position] : 0;
  }
};

/// A parameter's type P as it is written, an array of `Count` streams; with 0 it is P.
template <class P, int Count>
struct as_written {
  using type = P;
};
template <class T, int Depth, int Count>
struct as_written<stream<T, Depth>*, Count> {
  using type = std::conditional_t<Count == 0, stream<T, Depth>*, stream<T, Depth> (&)[Count == 0 ? 1 : Count]>;
};

}  // namespace hls::detail
