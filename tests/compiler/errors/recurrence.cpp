// The recurrence holds a multiplication and an addition of 32 bits: far longer than 6 ns.
// options: --clock 6ns
#include "ap_int.h"
#include "hls_stream.h"

void recurrence(hls::stream<ap_uint<32>>& in, hls::stream<ap_uint<32>>& out) {
#pragma HLS PIPELINE II = 1
  static ap_uint<32> state = 1;
  const ap_uint<32> x = in.read();
  state = state * state + x;  // refused: period
  out.write(state);
}
