// The leading one of every word of a block of run-time length: a bounded loop with a break inside the stream loop.
// one iteration a token of words
#include "ap_int.h"
#include "hls_stream.h"

void leading_ones(hls::stream<ap_uint<8>>& words, hls::stream<ap_uint<4>>& positions, unsigned char count) {
#pragma HLS INTERFACE axis port = words
#pragma HLS INTERFACE axis port = positions
#pragma HLS INTERFACE s_axilite port = count
  for (int i = 0; i < count; i++) {
#pragma HLS PIPELINE II = 1
    const ap_uint<8> word = words.read();
    ap_uint<4> position = 8;
    for (int bit = 7; bit >= 0; bit--) {
      if (word[bit]) {
        position = bit;
        break;
      }
    }
    positions.write(position);
  }
}
