#include "ap_int.h"
#include "hls_stream.h"

void partition_of_nothing(hls::stream<int>& in, hls::stream<int>& out) {
  static int taps[8];
#pragma HLS ARRAY_PARTITION variable = tabs complete  // refused: tabs
  taps[in.read() & 7] += 1;
  out.write(taps[0]);
}
