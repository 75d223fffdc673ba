#include "hls_stream.h"

static void first(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 1); }
static int second(hls::stream<int>& in, hls::stream<int>& out) {
  const int value = in.read();
  out.write(value * 2);
  return value;
}

void dataflow_value(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  first(in, between);
  second(between, out);  // refused: the process 'second' returns a value
}
