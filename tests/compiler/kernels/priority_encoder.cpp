// Leading one, population count and parity of a word: loops with break, a while loop with a bound, a do/while.
// one iteration a token of word
#include "ap_int.h"
#include "hls_stream.h"

struct summary_t {
  ap_uint<5> leading;  // 16 = none
  ap_uint<5> ones;
  ap_uint<1> parity;
  ap_uint<4> low_zeros;  // at most 15
};

void priority_encoder(hls::stream<ap_uint<16>>& word, hls::stream<summary_t>& summary) {
#pragma HLS PIPELINE II = 1
  const ap_uint<16> w = word.read();
  summary_t s;
  s.leading = 16;
  for (int i = 15; i >= 0; i--) {
    if (w[i]) {
      s.leading = i;
      break;
    }
  }
  s.ones = 0;
  for (int i = 0; i < 16; i++) s.ones += w[i];
  s.parity = w.xor_reduce();
  int zeros = 0;
  while (zeros < 15 && !w[zeros]) ++zeros;
  s.low_zeros = zeros;
  summary.write(s);
}
