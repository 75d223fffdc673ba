// State that a reset leaves alone, in a loop that looks ahead at its first pass: where the way from power-up meets the
// way from the packet before, the value at power-up was refused.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

void kept_until_last(hls::stream<ap_axiu<8, 1, 1, 1>>& in, hls::stream<ap_uint<8>>& out) {
  static ap_uint<8> sum = 2;
#pragma HLS RESET variable = sum off
  bool last = false;
  while (!last) {
    const ap_axiu<8, 1, 1, 1> beat = in.read();
    last = beat.last;
    sum += 3;
    out.write(beat.data + sum);
  }
}
