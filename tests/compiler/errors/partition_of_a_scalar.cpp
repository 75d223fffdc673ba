#include "ap_int.h"
#include "hls_stream.h"

void partition_of_a_scalar(hls::stream<int>& in, hls::stream<int>& out) {
  static int total;
#pragma HLS ARRAY_PARTITION variable = total complete  // refused: total
  total += in.read();
  out.write(total);
}
