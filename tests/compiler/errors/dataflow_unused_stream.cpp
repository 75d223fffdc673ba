#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void dataflow_unused_stream(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  hls::stream<int> spare;  // refused: the stream 'spare' is never read or written
  copy(in, between);
  copy(between, out);
}
