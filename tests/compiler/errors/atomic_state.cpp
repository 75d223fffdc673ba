#include <atomic>

#include "hls_stream.h"

void atomic_state(hls::stream<int>& in, hls::stream<int>& out) {
  static std::atomic<int> total{0};
  total += in.read();       // refused: atomic
  out.write(total.load());  // refused: atomic
}
