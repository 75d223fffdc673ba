#pragma once
// hls::task for the synthesis build: the compiler's frontend makes the call of a process of its constructor's.

#define hls_thread_local

namespace hls {

class task {
 public:
  template <class... P, class... A>
  explicit task(void (*function)(P...), A&... streams) noexcept;
};

}  // namespace hls
