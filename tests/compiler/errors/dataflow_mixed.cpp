#include "hls_stream.h"

static void first(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 1); }

void dataflow_mixed(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  first(in, between);
  for (int i = 0; i < 4; ++i) out.write(between.read() * 2);  // refused: a stream is accessed beside the calls
}
