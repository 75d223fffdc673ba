#include "ap_int.h"
#include "hls_stream.h"

void pipeline_misspelt(hls::stream<int>& in, hls::stream<int>& out, int n) {
  for (int i = 0; i < n; ++i) {
#pragma HLS PIPELIN II = 1  // refused: PIPELIN.*PIPELINE
    out.write(in.read());
  }
}
