#pragma once
// hls::task for the synthesis build: the compiler's frontend makes the call of a process of the
// constructor's and the operator's.

#define hls_thread_local

namespace hls {

class task {
 public:
  task() = default;
  template <class... P, class... A>
  explicit task(void (*function)(P...), A&... streams) noexcept;
  template <class... P, class... A>
  void operator()(void (*function)(P...), A&... streams) noexcept;
};

}  // namespace hls
