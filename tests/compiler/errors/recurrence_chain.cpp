// options: --clock 6ns
#include "ap_int.h"
#include "hls_stream.h"

void recurrence_chain(hls::stream<ap_int<40>>& in, hls::stream<ap_int<40>>& out, int n) {
  ap_int<40> low = 0;
  for (int i = 0; i < n; ++i) {
#pragma HLS PIPELINE II = 1
    const ap_int<40> error = in.read() - low;                         // refused: period
    const ap_int<40> step = error > 1000 ? ap_int<40>(1000) : error;  // refused: period
    low = low + (step * 3) / 4;                                       // refused: period
    out.write(low);
  }
}
