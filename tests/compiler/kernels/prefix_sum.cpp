// Prefix sums of signed packets; the sum starts anew after `last`. Sidebands pass through.
// one iteration a token of s
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axis<16, 2, 5, 6> in_t;
typedef ap_axis<32, 2, 5, 6> out_t;

void prefix_sum(hls::stream<in_t>& s, hls::stream<out_t>& m) {
#pragma HLS INTERFACE mode = axis port = s
#pragma HLS INTERFACE mode = axis port = m
#pragma HLS INTERFACE mode = ap_ctrl_none port = return
  static ap_int<32> sum = 0;
#pragma HLS RESET variable = sum
  in_t a = s.read();
  out_t b;
  b.data = sum + a.data;
  b.keep = -1;
  b.strb = -1;
  b.user = a.user;
  b.last = a.last;
  b.id = a.id;
  b.dest = a.dest;
  sum = a.last ? ap_int<32>(0) : ap_int<32>(b.data);
  m.write(b);
}
