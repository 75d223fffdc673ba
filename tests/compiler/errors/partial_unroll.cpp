#include "hls_stream.h"

void partial_unroll(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  int sum = 0;
  for (int i = 0; i < 64; ++i) {
#pragma HLS UNROLL factor = 4  // refused: UNROLL
    sum += x >> (i & 31);
  }
  out.write(sum);
}
