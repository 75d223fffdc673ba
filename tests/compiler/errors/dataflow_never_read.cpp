#include "hls_stream.h"

static void split(hls::stream<int>& in, hls::stream<int>& out, hls::stream<int>& rest) {
  const int value = in.read();
  out.write(value & 15);
  rest.write(value >> 4);
}
static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void dataflow_never_read(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> low;
  hls::stream<int> high;  // refused: the stream 'high' is written by the process .* and never read
  split(in, low, high);
  copy(low, out);
}
