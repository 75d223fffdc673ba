// Routes beats to three outputs by destination; broken destinations are counted, the count comes out with every
// packet's end. one iteration a token of in
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

using namespace hls;

typedef ap_axiu<16, 1, 1, 2> beat_t;

void router(stream<beat_t>& in, stream<ap_uint<16>>& a, stream<ap_uint<16>>& b, stream<ap_uint<16>>& c,
            stream<ap_uint<8>>& lost) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = a
#pragma HLS INTERFACE axis port = b
#pragma HLS INTERFACE axis port = c
#pragma HLS INTERFACE axis port = lost
#pragma HLS PIPELINE II = 1
  static ap_uint<8> count;
  beat_t x = in.read();
  switch (x.dest.to_uint()) {
    case 0:
      a << x.data;
      break;
    case 1:
      b << x.data;
      break;
    case 2:
      c << x.data;
      break;
    default:
      ++count;
  }
  if (x.last) {
    lost << count;
    count = 0;
  }
}
