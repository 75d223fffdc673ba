#include "hls_stream.h"

static void add(hls::stream<int>& in, hls::stream<int>& out, int more) { out.write(in.read() + more); }
static int measure(hls::stream<int>& in, hls::stream<int>& out) {
  const int value = in.read();
  out.write(value);
  return value;
}

void dataflow_kept(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  static int last = 0;
  hls::stream<int> between;
  add(in, between, last);
  last = measure(between, out);  // refused: 'measure' gives is kept in a static variable beside the calls
}
