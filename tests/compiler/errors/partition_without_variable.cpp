#include "ap_int.h"
#include "hls_stream.h"

void partition_without_variable(hls::stream<int>& in, hls::stream<int>& out) {
  static int taps[8];
#pragma HLS ARRAY_PARTITION complete  // refused: variable
  taps[in.read() & 7] += 1;
  out.write(taps[0]);
}
