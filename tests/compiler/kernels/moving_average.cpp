// Moving average of the last 32 samples with a circular buffer and a running sum; free running, one sample a call.
// one iteration a token of din
#include "ap_int.h"
#include "hls_stream.h"

#define N 32

void moving_average(hls::stream<ap_uint<12>>& din, hls::stream<ap_uint<12>>& dout) {
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS INTERFACE axis port = din
#pragma HLS INTERFACE axis port = dout
#pragma HLS PIPELINE II = 1
  static ap_uint<12> buffer[N];
  static ap_uint<5> ptr = 0;
  static ap_uint<17> sum = 0;
  static ap_uint<6> filled = 0;

  ap_uint<12> x = din.read();
  ap_uint<12> oldest = (filled == N) ? buffer[ptr] : ap_uint<12>(0);
  buffer[ptr] = x;
  ptr++;
  if (filled != N) filled++;
  sum += x - oldest;
  dout.write(sum / N);
}
