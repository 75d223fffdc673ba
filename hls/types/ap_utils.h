#pragma once
// The vendors' ap_wait and its kind. Natively they do nothing, as in the vendors' simulation. In hardware the schedule
// decides in which clock an operation takes place, so that a wait would mean nothing and is refused.

#include <ap_int.h>

#ifdef __SYNTHESIS__

namespace epiline {

template <bool used>
void refuse_wait() {
  static_assert(!used,
                "ap_wait: the schedule decides in which clock an operation takes place: count iterations of a loop, or "
                "wait for a token of a stream");
}

}  // namespace epiline

template <bool used = true>
void ap_wait() {
  epiline::refuse_wait<used>();
}
template <bool used = true>
void ap_wait_n(int) {
  epiline::refuse_wait<used>();
}
template <bool used = true>
void ap_wait_until(bool) {
  epiline::refuse_wait<used>();
}

#else

inline void ap_wait() {}
inline void ap_wait_n(int) {}
inline void ap_wait_until(bool) {}

#endif
