// Merges two packet streams: packets alternate while both are wanted; `order` says which one comes next (0, 1), or 2
// for "drop one token of the first", 3 for "insert a marker".
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<32, 4, 1, 1> word_t;

static word_t marker(ap_uint<4> tag) {
  word_t w;
  w.data = 0xDEADBEEF;
  w.keep = 0xf;
  w.strb = 0xf;
  w.user = tag;
  w.last = 1;
  w.id = 0;
  w.dest = 1;
  return w;
}

void arbiter(hls::stream<ap_uint<2>>& order, hls::stream<word_t>& first, hls::stream<word_t>& second,
             hls::stream<word_t>& merged) {
#pragma HLS INTERFACE axis port = order
#pragma HLS INTERFACE axis port = first
#pragma HLS INTERFACE axis port = second
#pragma HLS INTERFACE axis port = merged
  ap_uint<2> next = order.read();
  bool last = false;
  ap_uint<4> beats = 0;
  do {
#pragma HLS PIPELINE II = 1
    word_t w;
    bool forward = true;
    switch (next) {
      case 0:
        w = first.read();
        break;
      case 1:
        w = second.read();
        break;
      case 2:
        w = first.read();
        w.last = 1;
        forward = false;
        break;
      default:
        w = marker(beats);
        break;
    }
    if (next != 3) w.user = beats;
    beats++;
    last = w.last;
    if (forward) merged.write(w);
  } while (!last);
}
