// First-order low-pass y += (x - y) / 16 in fixed point with a run-time number of samples and start value.
// epiline-hls: --clock 12ns
// one iteration a token of y
#include "ap_int.h"
#include "hls_stream.h"

void leaky_integrator(hls::stream<ap_int<16>>& x, hls::stream<ap_int<16>>& y, int samples, short start) {
#pragma HLS INTERFACE s_axilite port = samples
#pragma HLS INTERFACE s_axilite port = start
  ap_int<20> state = ap_int<20>(start) << 4;
  for (int n = 0; n < samples; n++) {
#pragma HLS PIPELINE II = 1
    const ap_int<21> error = (ap_int<20>(x.read()) << 4) - state;
    state += error >> 4;
    y.write(state.range(19, 4));
  }
}
