#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }
static void through(hls::stream<int>& in, hls::stream<int>& out) {
  hls::stream<int> inner;
  inner.write(in.read());  // refused: an hls::stream inside of a process
  out.write(inner.read());
}

void dataflow_inner_stream(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  copy(in, between);
  through(between, out);
}
