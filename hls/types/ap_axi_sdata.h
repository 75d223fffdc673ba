#pragma once
// AXI4-Stream payloads: one token with its side channels, the vendors' names and meaning.
//
//   ap_axiu<D, U, TI, TD>     data ap_uint<D>, keep and strb ap_uint<bytes>, user ap_uint<U>, last ap_uint<1>,
//   ap_axis<D, U, TI, TD>     id ap_uint<TI>, dest ap_uint<TD>; ap_axis has ap_int<D> data
//   hls::axis<T, U, TI, TD>   data of any type T
//   hls::axis_data<T, E>      data and what E asks for
//   hls::axis_user<U, E>      user and what E asks for, no data
//   qdma_axis<D, 0, 0, 0>     data, keep and last
//
// keep and strb have a bit for each byte begun by the data. A width of 0 for U, TI or TD: the field does not exist,
// costs nothing and has no signal in the hardware's interface. The last parameters of the first three, E out of
// AXIS_ENABLE_KEEP, AXIS_ENABLE_STRB and AXIS_ENABLE_LAST, say which of these fields exist; without E all do. What is
// never written is 0, as hardware has it: sources leave out side channels that they do not need.
//
// Contract with the compiler's frontend (synthesis build). Each field stands in a base class of its own that holds
// { zero-length tag, value }. The tag is `int axis_field_tag[0][k]`, LLVM type [0 x [k x i32]], with k = 1 data, 2
// keep, 3 strb, 4 user, 5 last, 6 id, 7 dest. A struct with such tags is an AXI payload; its fields stand in the order
// of k, and absent fields have no tag. In the data of hls::axis an ap_int or ap_uint leaf carries its width as
// everywhere (detail/integer_synthesis.h), C integers have their own, and a bool is an i8 in memory.

#include <type_traits>

#include "ap_int.h"

// The vendors' names and values.
#define AXIS_ENABLE_DATA 0b00000001
#define AXIS_ENABLE_DEST 0b00000010
#define AXIS_ENABLE_ID 0b00000100
#define AXIS_ENABLE_KEEP 0b00001000
#define AXIS_ENABLE_LAST 0b00010000
#define AXIS_ENABLE_STRB 0b00100000
#define AXIS_ENABLE_USER 0b01000000
#define AXIS_ENABLE_ALL 0b01111111

namespace epiline::axis {

#ifdef __SYNTHESIS__
#define EPILINE_AXIS_FIELD_TAG(k) int axis_field_tag[0][k] __attribute__((packed));
#define EPILINE_AXIS_ZERO
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wzero-length-array"
#else
#define EPILINE_AXIS_FIELD_TAG(k)
#define EPILINE_AXIS_ZERO \
  {                       \
  }
#endif

template <class T>
struct data_field {
  EPILINE_AXIS_FIELD_TAG(1)
  T data EPILINE_AXIS_ZERO;
  constexpr T get_data() const { return data; }
  constexpr void set_data(const T& v) { data = v; }
};
template <>
struct data_field<void> {};

template <int W>
struct keep_field {
  EPILINE_AXIS_FIELD_TAG(2)
  ap_uint<W> keep EPILINE_AXIS_ZERO;
  constexpr ap_uint<W> get_keep() const { return keep; }
  constexpr void set_keep(const ap_uint<W>& v) { keep = v; }
  /// Marks every byte as part of the packet.
  constexpr void keep_all() { keep = ~ap_uint<W>(0); }
};
template <>
struct keep_field<0> {};

template <int W>
struct strb_field {
  EPILINE_AXIS_FIELD_TAG(3)
  ap_uint<W> strb EPILINE_AXIS_ZERO;
  constexpr ap_uint<W> get_strb() const { return strb; }
  constexpr void set_strb(const ap_uint<W>& v) { strb = v; }
  /// Marks every byte as data.
  constexpr void strb_all() { strb = ~ap_uint<W>(0); }
};
template <>
struct strb_field<0> {};

template <int W>
struct user_field {
  EPILINE_AXIS_FIELD_TAG(4)
  ap_uint<W> user EPILINE_AXIS_ZERO;
  constexpr ap_uint<W> get_user() const { return user; }
  constexpr void set_user(const ap_uint<W>& v) { user = v; }
};
template <>
struct user_field<0> {};

template <bool Exists>
struct last_field {
  EPILINE_AXIS_FIELD_TAG(5)
  ap_uint<1> last EPILINE_AXIS_ZERO;
  constexpr ap_uint<1> get_last() const { return last; }
  constexpr void set_last(const ap_uint<1>& v) { last = v; }
};
template <>
struct last_field<false> {};

template <int W>
struct id_field {
  EPILINE_AXIS_FIELD_TAG(6)
  ap_uint<W> id EPILINE_AXIS_ZERO;
  constexpr ap_uint<W> get_id() const { return id; }
  constexpr void set_id(const ap_uint<W>& v) { id = v; }
};
template <>
struct id_field<0> {};

template <int W>
struct dest_field {
  EPILINE_AXIS_FIELD_TAG(7)
  ap_uint<W> dest EPILINE_AXIS_ZERO;
  constexpr ap_uint<W> get_dest() const { return dest; }
  constexpr void set_dest(const ap_uint<W>& v) { dest = v; }
};
template <>
struct dest_field<0> {};

#ifdef __SYNTHESIS__
#pragma clang diagnostic pop
#endif
#undef EPILINE_AXIS_FIELD_TAG
#undef EPILINE_AXIS_ZERO

template <class T, class = void>
inline constexpr int bytes_of = static_cast<int>(sizeof(T));
template <>
inline constexpr int bytes_of<void> = 0;
template <int W, bool S>
inline constexpr int bytes_of<ap_int_base<W, S>> = (W + 7) / 8;
// Fixed point, without its header.
template <class T>
inline constexpr int bytes_of<T, std::void_t<decltype(T::width + T::iwidth)>> = (T::width + 7) / 8;

inline constexpr unsigned char usual_fields = AXIS_ENABLE_KEEP | AXIS_ENABLE_LAST | AXIS_ENABLE_STRB;

/// Of keep and strb in a payload with data of type T.
template <class T, unsigned char Fields, unsigned char Field>
inline constexpr int byte_flags = (Fields & Field) != 0 ? bytes_of<T> : 0;

}  // namespace epiline::axis

namespace hls {

template <class T, int U = 0, int TI = 0, int TD = 0, unsigned char Fields = epiline::axis::usual_fields,
          bool Strict = false>
struct axis : epiline::axis::data_field<T>,
              epiline::axis::keep_field<epiline::axis::byte_flags<T, Fields, AXIS_ENABLE_KEEP>>,
              epiline::axis::strb_field<epiline::axis::byte_flags<T, Fields, AXIS_ENABLE_STRB>>,
              epiline::axis::user_field<U>,
              epiline::axis::last_field<(Fields & AXIS_ENABLE_LAST) != 0>,
              epiline::axis::id_field<TI>,
              epiline::axis::dest_field<TD> {
  static_assert(U >= 0 && TI >= 0 && TD >= 0, "widths of side channels are not negative");
  using value_type = T;
};

template <class T, unsigned char Fields = epiline::axis::usual_fields, bool Strict = false>
using axis_data = axis<T, 0, 0, 0, Fields, Strict>;
template <int U, unsigned char Fields = epiline::axis::usual_fields, bool Strict = false>
using axis_user = axis<void, U, 0, 0, Fields, Strict>;

}  // namespace hls

template <int D, int U = 0, int TI = 0, int TD = 0, unsigned char Fields = epiline::axis::usual_fields,
          bool Strict = false>
using ap_axiu = hls::axis<ap_uint<D>, U, TI, TD, Fields, Strict>;
template <int D, int U = 0, int TI = 0, int TD = 0, unsigned char Fields = epiline::axis::usual_fields,
          bool Strict = false>
using ap_axis = hls::axis<ap_int<D>, U, TI, TD, Fields, Strict>;
template <int D, int U, int TI, int TD>
using qdma_axis = hls::axis<ap_uint<D>, U, TI, TD, AXIS_ENABLE_KEEP | AXIS_ENABLE_LAST>;
