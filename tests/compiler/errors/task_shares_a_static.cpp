#include "hls_task.h"

static void count(hls::stream<int>& in, hls::stream<int>& out) {
  static int jobs = 0;
  out.write(in.read() + jobs);
  ++jobs;  // refused: written by the process 'count' and used by the process 'count'
}

void task_shares_a_static(hls::stream<int> (&in)[2], hls::stream<int> (&out)[2]) {
  hls_thread_local hls::task counting[2];
  for (int i = 0; i < 2; ++i) {
#pragma HLS UNROLL
    counting[i](count, in[i], out[i]);
  }
}
