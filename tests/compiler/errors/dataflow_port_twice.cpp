#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void dataflow_port_twice(hls::stream<int>& in, hls::stream<int>& out, hls::stream<int>& other) {
#pragma HLS DATAFLOW
  copy(in, out);
  copy(in, other);  // refused: the stream 'in' is read by two processes
}
