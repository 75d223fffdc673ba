#pragma once
// hls::stream for the synthesis build: every access is a call the compiler's frontend knows. The third argument is
// never looked at; it exists so that the LLVM type of the token is known at the call.

extern "C" {
void __epiline_stream_read(const void* stream, void* value, const void* type) noexcept;
void __epiline_stream_write(const void* stream, const void* value, const void* type) noexcept;
bool __epiline_stream_empty(const void* stream) noexcept;
bool __epiline_stream_full(const void* stream) noexcept;
}

#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wundefined-var-template"

namespace epiline::detail {

/// Carries T's LLVM type to the frontend; declared, never defined.
template <class T>
struct type_tag {
  static T object;
};

}  // namespace epiline::detail

namespace hls {

template <class T, int DEPTH = 0>
class stream;

template <class T>
class stream<T, 0> {
 public:
  using value_type = T;
  static constexpr bool is_stream_of_tokens = true;  // for the frontend's pragmas

  stream() = default;  // an array of streams is made without a loop
  constexpr explicit stream(const char*) {}
  stream(const stream&) = delete;
  stream& operator=(const stream&) = delete;

  T read() {
    T value;
    __epiline_stream_read(this, &value, &epiline::detail::type_tag<T>::object);
    return value;
  }
  void read(T& value) { __epiline_stream_read(this, &value, &epiline::detail::type_tag<T>::object); }
  void operator>>(T& value) { read(value); }
  bool read_nb(T& value) {
    if (empty()) return false;
    read(value);
    return true;
  }
  void write(const T& value) { __epiline_stream_write(this, &value, &epiline::detail::type_tag<T>::object); }
  void operator<<(const T& value) { write(value); }
  bool write_nb(const T& value) {
    if (full()) return false;
    write(value);
    return true;
  }
  bool empty() const { return __epiline_stream_empty(this); }
  bool full() const { return __epiline_stream_full(this); }
};

template <class T, int DEPTH>
class stream : public stream<T, 0> {
  static_assert(DEPTH > 0, "the depth of a stream is positive");

 public:
  using stream<T, 0>::stream;
};

}  // namespace hls

#pragma clang diagnostic pop
