#include "ap_int.h"
#include "hls_stream.h"

void pipeline_without_a_number(hls::stream<int>& in, hls::stream<int>& out, int n) {
  for (int i = 0; i < n; ++i) {
#pragma HLS PIPELINE II = fast  // refused: 'fast'
    out.write(in.read());
  }
}
