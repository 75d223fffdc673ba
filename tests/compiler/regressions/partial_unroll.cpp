// UNROLL factor=N: some passes side by side, with a test for the end where the number of trips is not a multiple.
#include "ap_int.h"
#include "hls_stream.h"

void partial_unroll(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<16>>& out, ap_uint<6> count) {
  const int factor = 3;
  ap_uint<8> values[64];
  ap_uint<8> more[64];
  for (int i = 0; i < 10; ++i) values[i] = in.read();
  for (int i = 10; i < 64; ++i) {
#pragma HLS UNROLL factor = 2
    values[i] = i * 3;
  }

  ap_uint<16> sum = 0;
  for (int i = 0; i < count; ++i) {  // a number of trips that only the call knows
#pragma HLS UNROLL factor = 4
    sum += values[i];
  }
  out.write(sum);

  ap_uint<16> first = 0xffff;
  for (int i = 0; i < 50; ++i) {  // an early exit, and 50 is no multiple of 3
#pragma HLS UNROLL factor = factor
    if (values[i] > 100) {
      first = i;
      break;
    }
  }
  out.write(first);

  for (int i = 0; i < 64; ++i) {
#pragma HLS PIPELINE
#pragma HLS UNROLL factor = 4 skip_exit_check
    more[i] = values[i] + i;
  }
  for (int i = 0; i < 9; ++i) {  // accesses of streams, some of them conditional
#pragma HLS UNROLL factor = 2
    if (values[i] == 3) continue;
    out.write(more[i] + (i == 7 ? in.read() : ap_uint<8>(1)));
  }
  for (int i = 0; i < 4; ++i) {  // as many as there are, and one: all of them, and none
#pragma HLS UNROLL factor = 8
    out.write(more[60 + i]);
  }
  for (int i = 0; i < 3; ++i) {
#pragma HLS UNROLL factor = 1
    out.write(more[i + count]);
  }
}
