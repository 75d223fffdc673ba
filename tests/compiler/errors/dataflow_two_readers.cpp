#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void dataflow_two_readers(hls::stream<int>& in, hls::stream<int>& out, hls::stream<int>& other) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  copy(in, between);
  copy(between, out);
  copy(between, other);  // refused: the stream 'between' is read by two processes
}
