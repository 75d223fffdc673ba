#include "hls_stream.h"

static void first(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 1); }
static void second(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() * 2); }

void dataflow_condition(hls::stream<int>& in, hls::stream<int>& out, bool twice) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  first(in, between);
  if (twice) second(between, out);  // refused: 'second' is called only if a condition holds
}
