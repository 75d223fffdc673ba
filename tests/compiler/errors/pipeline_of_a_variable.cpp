#include "ap_int.h"
#include "hls_stream.h"

// The number of a pragma must be known when the circuit is made.
void pipeline_of_a_variable(hls::stream<int>& in, hls::stream<int>& out, int n) {
  for (int i = 0; i < n; ++i) {
#pragma HLS PIPELINE II = n  // refused: known at compile time
    out.write(in.read());
  }
}
