#include "ap_int.h"
#include "hls_stream.h"

void unroll_unknown_trips(hls::stream<int>& in, hls::stream<int>& out) {
  const int n = in.read();
  int sum = 0;
  for (int i = 0; i < n; ++i) {  // refused: UNROLL.*trips
#pragma HLS UNROLL
    sum += i * i;
  }
  out.write(sum);
}
