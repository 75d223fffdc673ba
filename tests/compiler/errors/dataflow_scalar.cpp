#include "hls_stream.h"

static void first(hls::stream<int>& in, hls::stream<int>& out, int& last) {
  last = in.read();
  out.write(last + 1);
}
static void second(hls::stream<int>& in, hls::stream<int>& out, int last) { out.write(in.read() * last); }

void dataflow_scalar(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  int last = 0;
  first(in, between, last);
  second(between, out, last);  // refused: 'last' is written by the process 'first' and used by
}
