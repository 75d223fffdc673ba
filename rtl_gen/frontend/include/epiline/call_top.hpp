#pragma once
// Calls a top function for ever, as the generated hardware does. Compiled together with the user's source in the
// synthesis build only; the frontend gives the __epiline_* functions their meaning.
//
// The parameters become ports by their types: a stream by reference is a port of its own; scalars by value (or const
// reference) are the fields of one argument token a call; scalars by reference, and what the top returns, are output
// streams of one token a call. A pointer to one scalar and a short array of them are references; those that the top
// only reads are arguments, as the frontend finds out. A long array is a stream of its elements, into the call or out
// of it. An array of streams counts as that many parameters, and so does what is returned.

#include <ap_int.h>
#include <detail/stream_arrays.h>
#include <hls_stream.h>

extern "C" {
void __epiline_argument(int index, void* value, const void* type) noexcept;
void __epiline_result(int index, const void* value, const void* type) noexcept;
void __epiline_port(int index, const void* stream) noexcept;
void __epiline_unwritten(int index, void* value, const void* type) noexcept;
void __epiline_unsupported_parameter(int index, int reason) noexcept;
void __epiline_array(int position, int count) noexcept;
void __epiline_values(int position, int count) noexcept;
void __epiline_data(int position, int count) noexcept;
bool __epiline_is_given(int index) noexcept;
bool __epiline_is_taken(int index) noexcept;
void* __epiline_elements(int index, void* values) noexcept;
void __epiline_single(int index, const void* value, long size) noexcept;
void __epiline_returned(int position) noexcept;
}

namespace epiline::detail {

template <class T>
struct parameter_type_tag {
  static T object;
};

// What a scalar's token looks like. LLVM's integers have no sign: C's signed ones travel under the name of the vendor
// type of their width.
template <class T, bool = __is_integral(T) && __is_signed(T)>
struct scalar_token {
  using type = T;
};
template <class T>
struct scalar_token<T, true> {
  using type = ap_int<8 * sizeof(T)>;
};

template <int Index, class Stream>
struct stream_port {
  static Stream object;
};

template <class T, int Index>
struct parameter {  // by value
  T value;
  parameter() { __epiline_argument(Index, &value, &parameter_type_tag<typename scalar_token<T>::type>::object); }
  T& pass() { return value; }
  void finish() const {}
};

// A bool is one bit; in memory it has eight.
template <int Index>
struct parameter<bool, Index> {
  ap_uint<1> value;
  parameter() { __epiline_argument(Index, &value, &parameter_type_tag<ap_uint<1>>::object); }
  bool pass() { return value != 0; }
  void finish() const {}
};

template <class T, int Index>
struct parameter<const T&, Index> : parameter<T, Index> {};

// A result. What it holds before the top writes it is nobody's: a call that gives that out is refused.
template <class T, int Index>
struct parameter<T&, Index> {
  T value;
  parameter() { __epiline_unwritten(Index, &value, &parameter_type_tag<typename scalar_token<T>::type>::object); }
  T& pass() { return value; }
  void finish() const { __epiline_result(Index, &value, &parameter_type_tag<typename scalar_token<T>::type>::object); }
};

template <int Index>
struct parameter<bool&, Index> {
  bool value;
  parameter() { __epiline_unwritten(Index, &value, &parameter_type_tag<unsigned char>::object); }
  bool& pass() { return value; }
  void finish() const {
    const ap_uint<1> bit = value;
    __epiline_result(Index, &bit, &parameter_type_tag<ap_uint<1>>::object);
  }
};

template <class Stream, int Index>
struct stream_parameter {
  stream_parameter() { __epiline_port(Index, &stream_port<Index, Stream>::object); }
  Stream& pass() const { return stream_port<Index, Stream>::object; }
  void finish() const {}
};

template <class T, int Depth, int Index>
struct parameter<hls::stream<T, Depth>&, Index> : stream_parameter<hls::stream<T, Depth>, Index> {};

template <int Index, class Stream, unsigned long Count>
struct stream_ports {
  static Stream objects[Count];
};

template <class T, int Depth, unsigned long Count, int Index>
struct parameter<hls::stream<T, Depth> (&)[Count], Index> {
  using stream = hls::stream<T, Depth>;
  using ports = stream_ports<Index, stream, Count>;
  parameter() { name_ports(std::make_integer_sequence<int, Count>()); }
  stream (&pass() const)[Count] { return ports::objects; }
  void finish() const {}

 private:
  template <int... I>
  void name_ports(std::integer_sequence<int, I...>) {
    (__epiline_port(Index + I, &ports::objects[I]), ...);
  }
};

// The frontend has a sentence for each.
enum class reason { pointer, array, stream_by_value, rvalue };

template <int Index, reason Reason>
struct unsupported_parameter {
  unsupported_parameter() { __epiline_unsupported_parameter(Index, static_cast<int>(Reason)); }
};

using hls::detail::is_stream;

template <class P, int Index>
struct single_value : parameter<P, Index> {  // behind a pointer
  single_value() { __epiline_single(Index, &this->value, sizeof(this->value)); }
};

template <class T, int Index>
constexpr auto pointer_parameter() {
  if constexpr (std::is_void_v<T> || std::is_function_v<T> || std::is_pointer_v<T> || std::is_array_v<T> ||
                is_stream<T>)
    return static_cast<unsupported_parameter<Index, reason::pointer>*>(nullptr);
  else
    return static_cast<single_value<T&, Index>*>(nullptr);
}

template <class T, int Index>
struct parameter<T*, Index> : std::remove_pointer_t<decltype(pointer_parameter<T, Index>())> {
  auto* pass() { return &this->value; }
};
// A pointer in memory is a byte, of which the value takes a bit.
template <int Index>
struct parameter<const bool*, Index> : unsupported_parameter<Index, reason::pointer> {};

// The payload that an array is.
template <class T, unsigned long Size>
struct array_token {
  T values[Size];
};

template <class T, unsigned long Size, int Index>
struct array_result {
  T values[Size];
  array_result() { __epiline_unwritten(Index, &values, &parameter_type_tag<array_token<T, Size>>::object); }
  T (&pass())[Size] { return values; }
  void finish() const { __epiline_result(Index, &values, &parameter_type_tag<array_token<T, Size>>::object); }
};

template <class T, unsigned long Size, int Index>
struct array_argument {
  T values[Size];
  array_argument() { __epiline_argument(Index, &values, &parameter_type_tag<array_token<T, Size>>::object); }
  const T (&pass() const)[Size] { return values; }
  void finish() const {}
};

// Data: the elements come before the call if the top reads them, and go after it if the top writes them, which the
// frontend finds out: accesses of its own go by way of elements(), to tell them from those of the top. What a call does
// not write is as an earlier one left it, at first 0.
template <class T, unsigned long Size, int Index>
struct array_data {
  using element = std::remove_all_extents_t<T>;
  using port = stream_port<Index, hls::stream<element>>;
  static T values[Size];
  array_data() {
    __epiline_port(Index, &port::object);
    if (__epiline_is_given(Index)) read(*elements());
  }
  T (&pass())[Size] { return values; }
  void finish() const {
    if (__epiline_is_taken(Index)) write(*elements());
  }

 private:
  static T (*elements())[Size] { return static_cast<T(*)[Size]>(__epiline_elements(Index, &values)); }

  template <class U>
  static void read(U& value) {
    if constexpr (std::is_array_v<U>)
      for (unsigned long i = 0; i < std::extent_v<U>; ++i) read(value[i]);
    else
      value = port::object.read();
  }
  template <class U>
  static void write(const U& value) {
    if constexpr (std::is_array_v<U>)
      for (unsigned long i = 0; i < std::extent_v<U>; ++i) write(value[i]);
    else
      port::object.write(value);
  }
};
template <class T, unsigned long Size, int Index>
T array_data<T, Size, Index>::values[Size];

template <template <class, unsigned long, int> class Kind, class T, unsigned long Size, int Index>
constexpr auto array_parameter() {
  using element = std::remove_all_extents_t<T>;
  if constexpr (std::is_pointer_v<element> || is_stream<element> || Size == 0)
    return static_cast<unsupported_parameter<Index, reason::array>*>(nullptr);
  else
    return static_cast<Kind<T, Size, Index>*>(nullptr);
}

template <class T, unsigned long Size, int Index>
struct parameter<T (&)[Size], Index>
    : std::remove_pointer_t<decltype(array_parameter<array_result, T, Size, Index>())> {};
template <class T, unsigned long Size, int Index>
struct parameter<const T (&)[Size], Index>
    : std::remove_pointer_t<decltype(array_parameter<array_argument, T, Size, Index>())> {};
template <class T, unsigned long Size, int Index>
struct parameter<hls::detail::data_of<T[Size]>, Index> : array_data<T, Size, Index> {};
template <class T, unsigned long Size, int Index>
struct parameter<hls::detail::data_of<const T[Size]>, Index> : array_data<T, Size, Index> {};
template <class T, int Depth, int Index>
struct parameter<hls::stream<T, Depth>, Index> : unsupported_parameter<Index, reason::stream_by_value> {};
template <class T, int Depth, int Index>
struct parameter<const hls::stream<T, Depth>&, Index> : unsupported_parameter<Index, reason::stream_by_value> {};
template <class T, int Index>
struct parameter<T&&, Index> : unsupported_parameter<Index, reason::rvalue> {};

constexpr bool is_unsupported(...) { return false; }
template <int Index, reason Reason>
constexpr bool is_unsupported(const unsupported_parameter<Index, Reason>*) {
  return true;
}

template <class P>
inline constexpr int streams_in_array = 0;
template <class T, int Depth, unsigned long Count>
inline constexpr int streams_in_array<hls::stream<T, Depth> (&)[Count]> = Count;

/// The index of the parameter at a position, behind all those that the arrays before it count as.
template <class... P>
constexpr int index_of(int position) {
  const int counts[] = {streams_in_array<P>..., 0};
  int index = position;
  for (int i = 0; i < position; ++i) index += counts[i] == 0 ? 0 : counts[i] - 1;
  return index;
}

template <class P>
inline constexpr int elements_of_data = 0;
template <class T, unsigned long Size>
inline constexpr int elements_of_data<hls::detail::data_of<T[Size]>> = Size;

template <class P, int Position>
void note_array() {
  using array = std::remove_reference_t<P>;
  if constexpr (streams_in_array<P> != 0)
    __epiline_array(Position, streams_in_array<P>);
  else if constexpr (elements_of_data<P> != 0)
    __epiline_data(Position, elements_of_data<P>);
  else if constexpr (std::is_array_v<array>)
    __epiline_values(Position, std::extent_v<array>);
}

template <auto Top, class Result, int ResultIndex, class... Parameters>
void pass_parameters(Parameters&&... parameters) {
  if constexpr (!(is_unsupported(static_cast<Parameters*>(nullptr)) || ...)) {
    if constexpr (std::is_void_v<Result>) {
      Top(parameters.pass()...);
    } else {
      __epiline_returned(sizeof...(Parameters));
      parameter<Result&, ResultIndex> returned;
      returned.pass() = Top(parameters.pass()...);
      returned.finish();
    }
    (parameters.finish(), ...);
  }
}

template <auto Top, class Result, class... P, int... Position>
void call_once(Result (*)(P...), std::integer_sequence<int, Position...>) {
  (note_array<P, Position>(), ...);
  pass_parameters<Top, Result, index_of<P...>(sizeof...(P))>(parameter<P, index_of<P...>(Position)>{}...);
}

template <auto Top, class Counts, class Result, class... P, int... Position>
void call_written(Result (*)(P...), std::integer_sequence<int, Position...> positions) {
  Result (*top)(typename hls::detail::as_written<P, Counts::at(Position)>::type...) = nullptr;
  for (;;) call_once<Top>(top, positions);
}

/// `Counts`: of the elements of each parameter written as an array, or 0.
template <auto Top, int... Counts, class Result, class... P>
void call_for_ever(Result (*top)(P...)) {
  static_assert(!std::is_pointer_v<Result> && !std::is_reference_v<Result>, "the top returns a pointer");
  call_written<Top, hls::detail::element_counts<Counts...>>(top, std::make_integer_sequence<int, sizeof...(P)>());
}

}  // namespace epiline::detail
