#include "hls_stream.h"

void slower_interval(hls::stream<int>& in, hls::stream<int>& out) {
  for (int i = 0; i < 64; ++i) {
#pragma HLS PIPELINE II=2  // refused: II|PIPELINE
    out.write(in.read());
  }
}
