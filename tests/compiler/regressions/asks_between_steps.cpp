// A state machine that asks for tokens in some of its steps only, beside a switch over all values of a number, and with
// a variable of which each half is written by itself.
#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <hls_stream.h>

typedef ap_axiu<32, 0, 0, 0> word_t;

void asks_between_steps(hls::stream<word_t>& in, hls::stream<word_t>& out, hls::stream<ap_uint<1>>& is_good) {
#pragma HLS PIPELINE II = 1
  static ap_uint<17> sums[2] = {0, 0};
  static ap_uint<1> step = 0;
  static bool is_last = false;
  if (is_last) {
    switch (step) {
      case 0:
        sums[0] = sums[0] + sums[1];
        sums[0] = (sums[0] + (sums[0] >> 16)) & 0xffff;
        step = 1;
        break;
      case 1:
        is_good.write(sums[0][0] == 0);
        sums[0] = 0;
        sums[1] = 0;
        step = 0;
        is_last = false;
        break;
    }
  } else if (!in.empty()) {
    const word_t word = in.read();
    for (int i = 0; i < 2; ++i) {
#pragma HLS UNROLL
      ap_uint<16> half;
      half(7, 0) = word.data(16 * i + 15, 16 * i + 8);
      half(15, 8) = word.data(16 * i + 7, 16 * i);
      sums[i] += half;
      sums[i] = (sums[i] + (sums[i] >> 16)) & 0xffff;
    }
    out.write(word);
    is_last = word.last;
  }
}
