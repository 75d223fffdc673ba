// State that a reset leaves alone was refused where the optimiser handed a loop a changed initial value, where nothing
// ever changes it, and where a loop of its own comes before the first read.
#include "ap_int.h"
#include "hls_stream.h"

void kept_at_reset(hls::stream<ap_int<12>>& in, hls::stream<ap_int<67>>& out) {
  static ap_uint<65> sum = 1073741823;
#pragma HLS RESET variable = sum off
  static ap_int<3> never_changed = -4;
#pragma HLS RESET variable = never_changed off
  static ap_int<5> steps = 2;
#pragma HLS RESET variable = steps off
  static ap_uint<8> tick = 0;
  ap_int<12> ram[32];
  for (int i = 0; i < 32; ++i) {
#pragma HLS PIPELINE II = 1
    ram[i] = i * 71 + tick;
  }
  for (int i = 0; i < 8; ++i) {
#pragma HLS PIPELINE II = 1
    const ap_int<12> value = in.read();
    sum = (sum | value) ^ ram[ap_uint<5>(value)];
    steps += 1;
    out.write(sum + (never_changed ^ steps));
    tick++;
  }
}
