#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }
static void inner(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW  // refused: DATAFLOW in .*inner.*, which is called from inside of a process
  copy(in, out);
}
static void outer(hls::stream<int>& in, hls::stream<int>& out) { inner(in, out); }

void dataflow_nested(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  copy(in, between);
  outer(between, out);
}
