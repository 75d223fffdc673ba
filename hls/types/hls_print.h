#pragma once
// hls::print: text on the standard output while the source runs natively. Hardware prints nothing.

#ifndef __SYNTHESIS__
#include <cstdio>
#include <type_traits>
#endif

namespace hls {

#ifdef __SYNTHESIS__

inline void print(const char*) {}
template <class T>
void print(const char*, const T&) {}

#else

inline void print(const char* text) { std::fputs(text, stdout); }

/// `format` is that of printf with one conversion, %d or %x of an int, %f or %g of a double.
template <class T>
void print(const char* format, const T& value) {
  using argument = std::conditional_t<std::is_floating_point_v<T>, double, int>;
  std::printf(format, static_cast<argument>(value));
}

#endif

}  // namespace hls
