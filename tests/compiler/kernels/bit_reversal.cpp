// Bit-reversed reordering of blocks of 64 (as before an FFT): write in order, read in reversed order. Also reverses
// the bits of each value itself, in three spellings that must agree.
#include "ap_int.h"
#include "hls_stream.h"

#define LOG2 6

void bit_reversal(hls::stream<ap_uint<24>>& in, hls::stream<ap_uint<24>>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
  ap_uint<24> block[1 << LOG2];
write_loop:
  for (int i = 0; i < (1 << LOG2); i++) {
#pragma HLS PIPELINE II = 1
    block[i] = in.read();
  }
read_loop:
  for (ap_uint<LOG2 + 1> i = 0; i < (1 << LOG2); i++) {
#pragma HLS PIPELINE II = 1
    ap_uint<LOG2> address = i.range(LOG2 - 1, 0);
    address.reverse();
    ap_uint<24> v = block[address];
    ap_uint<8> high = v.range(23, 16), middle = v(15, 8), low = v.range(7, 0);
    high = high.range(0, 7);
    middle.reverse();
    ap_uint<8> turned;
    for (int b = 0; b < 8; b++) turned[b] = low[7 - b];
    out.write((turned, middle, high));
  }
}
