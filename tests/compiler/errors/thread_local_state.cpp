#include "ap_int.h"
#include "hls_stream.h"

void thread_local_state(hls::stream<int>& in, hls::stream<int>& out) {
  thread_local int total = 0;  // refused: thread_local
  total += in.read();          // refused: thread_local
  out.write(total);            // refused: thread_local
}
