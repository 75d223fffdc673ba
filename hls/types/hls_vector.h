#pragma once
// hls::vector<T, N>: N values of one type that are computed with side by side, with the vendors' names and meaning.
//
//   v + w, v - w, *, /, %, &, |, ^, <<, >>   of each element; the results are T again. Either side may be one value,
//   +=, -=, ...  ++v, v++, -v, ~v            which then stands for N of the same
//   v == w, v != w                           whether all elements are equal, or not
//   v < w, <=, >, >=                         by the first element that differs
//   v[i], v.begin(), v.end(), v.fill(value)
//   v.reduce_add(), _mult, _and, _or, _xor   all elements in one T, as a tree
//
// `vector<T, N> v = {a, b, ...}` takes N values, `vector<T, N> v(a)` one for all. Without either the elements are
// uninitialised. An hls::vector is a payload of streams like any struct: element 0 stands in the lowest bits.

#include <cstddef>
#include <type_traits>
#include <utility>

namespace hls {

template <class T, std::size_t N>
class vector {
  static_assert(N > 0, "an hls::vector has at least one element");

 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;
  static constexpr std::size_t length = N;

  vector() = default;
  constexpr vector(const T& value) : vector(value, every()) {}
  template <class U, std::enable_if_t<std::is_arithmetic_v<U> && !std::is_same_v<U, T>, int> = 0>
  constexpr vector(U value) : vector(T(value), every()) {}
  template <class... U, std::enable_if_t<sizeof...(U) == N && (N > 1), int> = 0>
  constexpr vector(const U&... values) : elements_{T(values)...} {}

  constexpr T& operator[](std::size_t index) { return elements_[index]; }
  constexpr const T& operator[](std::size_t index) const { return elements_[index]; }
  static constexpr std::size_t size() { return N; }
  constexpr T* begin() { return elements_; }
  constexpr const T* begin() const { return elements_; }
  constexpr T* end() { return elements_ + N; }
  constexpr const T* end() const { return elements_ + N; }
  constexpr T* data() { return elements_; }
  constexpr const T* data() const { return elements_; }

  constexpr void fill(const T& value) { *this = vector(value); }

#define EPILINE_HLS_VECTOR_OPERATOR(symbol, compound)                                \
  friend constexpr vector operator symbol(const vector& left, const vector& right) { \
    return each(every(), [&](std::size_t i) { return T(left[i] symbol right[i]); }); \
  }                                                                                  \
  constexpr vector& operator compound(const vector & other) { return *this = *this symbol other; }
  EPILINE_HLS_VECTOR_OPERATOR(+, +=)
  EPILINE_HLS_VECTOR_OPERATOR(-, -=)
  EPILINE_HLS_VECTOR_OPERATOR(*, *=)
  EPILINE_HLS_VECTOR_OPERATOR(/, /=)
  EPILINE_HLS_VECTOR_OPERATOR(%, %=)
  EPILINE_HLS_VECTOR_OPERATOR(&, &=)
  EPILINE_HLS_VECTOR_OPERATOR(|, |=)
  EPILINE_HLS_VECTOR_OPERATOR(^, ^=)
  EPILINE_HLS_VECTOR_OPERATOR(<<, <<=)
  EPILINE_HLS_VECTOR_OPERATOR(>>, >>=)
#undef EPILINE_HLS_VECTOR_OPERATOR

  constexpr vector operator+() const { return *this; }
  constexpr vector operator-() const { return vector(T(0)) - *this; }
  constexpr vector operator~() const {
    return each(every(), [&](std::size_t i) { return T(~elements_[i]); });
  }
  constexpr vector& operator++() { return *this += vector(T(1)); }
  constexpr vector& operator--() { return *this -= vector(T(1)); }
  constexpr vector operator++(int) {
    const vector old = *this;
    ++*this;
    return old;
  }
  constexpr vector operator--(int) {
    const vector old = *this;
    --*this;
    return old;
  }

  friend constexpr bool operator==(const vector& a, const vector& b) { return a.is_equal(b, every()); }
  friend constexpr bool operator<(const vector& a, const vector& b) { return a.template is_less<0>(b); }
  friend constexpr bool operator!=(const vector& a, const vector& b) { return !(a == b); }
  friend constexpr bool operator>(const vector& a, const vector& b) { return b < a; }
  friend constexpr bool operator<=(const vector& a, const vector& b) { return !(b < a); }
  friend constexpr bool operator>=(const vector& a, const vector& b) { return !(a < b); }

  constexpr T reduce_add() const {
    return reduced<0, N>([](const T& a, const T& b) { return T(a + b); });
  }
  constexpr T reduce_mult() const {
    return reduced<0, N>([](const T& a, const T& b) { return T(a * b); });
  }
  constexpr T reduce_and() const {
    return reduced<0, N>([](const T& a, const T& b) { return T(a & b); });
  }
  constexpr T reduce_or() const {
    return reduced<0, N>([](const T& a, const T& b) { return T(a | b); });
  }
  constexpr T reduce_xor() const {
    return reduced<0, N>([](const T& a, const T& b) { return T(a ^ b); });
  }

 private:
  // Packs instead of loops: they need no unrolling.
  using every = std::make_index_sequence<N>;
  template <std::size_t... I>
  constexpr vector(const T& value, std::index_sequence<I...>) : elements_{((void)I, value)...} {}
  struct elementwise {};
  template <std::size_t... I, class Of>
  constexpr vector(elementwise, std::index_sequence<I...>, Of of) : elements_{of(I)...} {}
  template <std::size_t... I, class Of>
  static constexpr vector each(std::index_sequence<I...> all, Of of) {
    return vector(elementwise(), all, of);
  }
  template <std::size_t... I>
  constexpr bool is_equal(const vector& other, std::index_sequence<I...>) const {
    return ((elements_[I] == other[I]) & ...);
  }
  template <std::size_t First>
  constexpr bool is_less(const vector& other) const {
    if constexpr (First == N) {
      return false;
    } else {
      return elements_[First] < other[First] || (elements_[First] == other[First] && is_less<First + 1>(other));
    }
  }
  template <std::size_t First, std::size_t Count, class Operation>
  constexpr T reduced(Operation of) const {
    if constexpr (Count == 1) {
      return elements_[First];
    } else {
      return of(reduced<First, Count / 2>(of), reduced<First + Count / 2, Count - Count / 2>(of));
    }
  }

  T elements_[N];
};

}  // namespace hls
