#include "hls_stream.h"

// One call that may be any of several processes.
static void copy(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read());  // refused: is both read and written
}

void dataflow_chosen(hls::stream<int>& in, hls::stream<int>& out, unsigned count) {
#pragma HLS DATAFLOW
  hls::stream<int> between[4];
  copy(in, between[0]);
  for (unsigned i = 1; i < count; ++i) copy(between[i - 1], between[i]);
  copy(between[3], out);
}
