// Whether a word is written depends on another word of the same RAM; what is written does not. Was refused at every
// period.
#include "ap_int.h"
#include "hls_stream.h"

void ram_write_condition(hls::stream<ap_uint<12>>& in, hls::stream<ap_uint<6>>& out) {
#pragma HLS PIPELINE II = 1
  static ap_uint<6> ram[64] = {0};
  const ap_uint<12> x = in.read();
  const ap_uint<6> word = ram[x.range(5, 0)];
  if (word < 32) ram[x.range(11, 6)] = x.range(8, 3);
  out.write(word);
}
