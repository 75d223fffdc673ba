// A loop marked UNROLL that always ends in its first pass: the optimiser takes it away, and its pragma passed to the
// loop around, whose trips are not known.
#include "ap_int.h"
#include "hls_stream.h"

void unrolled_once(hls::stream<ap_uint<16>>& in, hls::stream<ap_uint<20>>& out, int rows) {
  for (int i = 0; i < 4 * rows; ++i) {
#pragma HLS PIPELINE II = 1
    const ap_uint<16> value = in.read();
    ap_uint<20> sum = value;
    for (int k = 0; k < 4; k++) {
#pragma HLS UNROLL
      if ((value << 1) > -2) break;
      sum += value[k];
    }
    out.write(sum);
  }
}
