#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

// A loop that ends the call, or goes on with the next process.
void dataflow_left_early(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  while (true) {
    const int value = in.read();  // refused: beside the calls cannot be made a process: put it into a function
    if (value == 0) break;
    if (value == 1) return;
    between.write(value);
  }
  copy(between, out);
}
