#pragma once
// Calls a top function for ever, as the generated hardware does. Compiled together with the user's source in the
// synthesis build only; the frontend gives the __epiline_* functions their meaning.
//
// The parameters become ports by their types: a stream by reference is a port of its own; scalars by value (or const
// reference) are the fields of one argument token a call; scalars by reference are output streams of one token a call.

#include <ap_int.h>
#include <hls_stream.h>

extern "C" {
void __epiline_argument(int index, void* value, const void* type) noexcept;
void __epiline_result(int index, const void* value, const void* type) noexcept;
void __epiline_port(int index, const void* stream) noexcept;
void __epiline_unwritten(int index, void* value, const void* type) noexcept;
void __epiline_unsupported_parameter(int index, int reason) noexcept;
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

// The frontend has a sentence for each.
enum class reason { pointer, array, stream_by_value, rvalue };

template <int Index, reason Reason>
struct unsupported_parameter {
  unsupported_parameter() { __epiline_unsupported_parameter(Index, static_cast<int>(Reason)); }
};

template <class T, int Index>
struct parameter<T*, Index> : unsupported_parameter<Index, reason::pointer> {};
template <class T, unsigned long Size, int Index>
struct parameter<T (&)[Size], Index> : unsupported_parameter<Index, reason::array> {};
template <class T, unsigned long Size, int Index>
struct parameter<const T (&)[Size], Index> : unsupported_parameter<Index, reason::array> {};
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

template <int... Index>
struct indices {};

template <auto Top, class... Parameters>
void pass_parameters(Parameters&&... parameters) {
  if constexpr (!(is_unsupported(static_cast<Parameters*>(nullptr)) || ...)) {
    Top(parameters.pass()...);
    (parameters.finish(), ...);
  }
}

template <class T>
inline constexpr bool is_void = false;
template <>
inline constexpr bool is_void<void> = true;

template <auto Top, class... P, int... Index>
void call_once(void (*)(P...), indices<Index...>) {
  pass_parameters<Top>(parameter<P, Index>{}...);
}

template <int Count, int... Index>
struct make_indices : make_indices<Count - 1, Count - 1, Index...> {};
template <int... Index>
struct make_indices<0, Index...> {
  using type = indices<Index...>;
};

template <auto Top, class Result, class... P>
void call_for_ever(Result (*)(P...)) {
  static_assert(is_void<Result>, "the top returns a value");
  void (*top)(P...) = nullptr;
  for (;;) call_once<Top>(top, typename make_indices<sizeof...(P)>::type{});
}

}  // namespace epiline::detail
