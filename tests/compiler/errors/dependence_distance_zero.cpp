#include "ap_int.h"
#include "hls_stream.h"

void dependence_distance_zero(hls::stream<ap_uint<8>>& in, hls::stream<int>& out) {
  static int counts[256];
#pragma HLS DEPENDENCE variable = counts type = inter distance = 0 true  // refused: distance.*0
  const ap_uint<8> at = in.read();
  counts[at] += 1;
  out.write(counts[at]);
}
