#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void dataflow_two_writers(hls::stream<int>& in, hls::stream<int>& other, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  copy(in, between);
  copy(other, between);  // refused: the stream 'between' is written by two processes
  copy(between, out);
}
