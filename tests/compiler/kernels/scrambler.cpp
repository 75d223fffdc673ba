// Self-synchronous scrambler x^58 + x^39 + 1 of 64-bit words (as in 10GBASE-R): 64 steps a clock, headers untouched.
// one iteration a token of plain
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<66> block_t;

void scrambler(hls::stream<block_t>& plain, hls::stream<block_t>& scrambled) {
#pragma HLS INTERFACE axis port = plain
#pragma HLS INTERFACE axis port = scrambled
#pragma HLS PIPELINE II = 1
  static ap_uint<58> state = 0x3FFFFFFFFFFFFFFULL;
  const block_t b = plain.read();
  const ap_uint<64> data = b.range(65, 2);
  ap_uint<64> result;
  ap_uint<58> s = state;
  for (int i = 0; i < 64; i++) {
    const ap_uint<1> bit = data[i] ^ s[57] ^ s[38];
    result[i] = bit;
    s = (s.range(56, 0), bit);
  }
  state = s;
  block_t o;
  o.range(1, 0) = b.range(1, 0);
  o.range(65, 2) = result;
  scrambled.write(o);
}
