#include "hls_stream.h"

static void first(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 1); }
static void second(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() * 2); }

void dataflow_in_loop(hls::stream<int>& in, hls::stream<int>& out, int frames) {
  for (int i = 0; i < frames; ++i) {
#pragma HLS DATAFLOW
    hls::stream<int> between;
    first(in, between);  // refused: 'first' is called in a loop
    second(between, out);
  }
}
