#include "hls_stream.h"

void unknown_pragma(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS FROBNICATE variable = in  // refused: FROBNICATE
  out.write(in.read());
}
