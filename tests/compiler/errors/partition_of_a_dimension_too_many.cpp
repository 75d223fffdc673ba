#include "ap_int.h"
#include "hls_stream.h"

void partition_of_a_dimension_too_many(hls::stream<int>& in, hls::stream<int>& out) {
  static int taps[8];
#pragma HLS ARRAY_PARTITION variable = taps complete dim = 3  // refused: dim
  taps[in.read() & 7] += 1;
  out.write(taps[0]);
}
