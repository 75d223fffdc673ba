// Tasks between the top's own streams, none between tasks: they were one process, which waited for tokens of both.
#include "ap_int.h"
#include "hls_task.h"

void add_three(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<9>>& out) { out.write(in.read() + 3); }

void tasks_side_by_side(hls::stream<ap_uint<8>> (&in)[2], hls::stream<ap_uint<9>> (&out)[2]) {
  hls_thread_local hls::task adding[2];
  for (int i = 0; i < 2; ++i) {
#pragma HLS UNROLL
    adding[i](add_three, in[i], out[i]);
  }
}
