#include "ap_int.h"
#include "hls_stream.h"

void pipeline_negative(hls::stream<int>& in, hls::stream<int>& out, int n) {
  for (int i = 0; i < n; ++i) {
#pragma HLS PIPELINE II = -2  // refused: PIPELINE.*-2
    out.write(in.read());
  }
}
