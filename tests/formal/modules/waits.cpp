// What a token carries waits for a sum of it: 232 bits for so long as three multiplications take, in LUT RAM, whose
// pointers have a copy; 40 bits for twice as long, in block RAM.
#include "ap_int.h"
#include "hls_stream.h"

struct carried {
  ap_uint<116> left, right;
  ap_uint<40> narrow;
  ap_uint<24> number;
};

void waits(hls::stream<carried>& in, hls::stream<ap_uint<256>>& out, hls::stream<ap_uint<64>>& late) {
#pragma HLS PIPELINE II = 1
  const carried token = in.read();
  ap_uint<24> product = token.number;
  for (int i = 0; i < 3; ++i) product = product * product + 3;
  out.write((token.left, token.right, product));
  for (int i = 0; i < 3; ++i) product = product * product + 5;
  late.write((token.narrow, product));
}
