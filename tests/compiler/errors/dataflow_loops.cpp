#include "ap_int.h"
#include "hls_stream.h"

// Loops are no processes: each needs a function.
void dataflow_loops(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW  // refused: no function that takes streams is called
  hls::stream<int, 2> between;
  for (int i = 0; i < 4; ++i) between.write(in.read() + 1);   // refused: accessed beside the calls
  for (int i = 0; i < 4; ++i) out.write(between.read() * 2);  // refused: DATAFLOW, but no function that takes streams
}
