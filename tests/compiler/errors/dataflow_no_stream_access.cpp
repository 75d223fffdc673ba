#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }
static void nothing(hls::stream<int>&) {}

void dataflow_no_stream_access(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  copy(in, between);
  nothing(between);  // refused: this process neither reads nor writes a stream
  copy(between, out);
}
