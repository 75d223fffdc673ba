#include "ap_int.h"
#include "hls_stream.h"

void pipeline_wrong_option(hls::stream<int>& in, hls::stream<int>& out, int n) {
  for (int i = 0; i < n; ++i) {
#pragma HLS PIPELINE interval = 2  // refused: interval
    out.write(in.read());
  }
}
