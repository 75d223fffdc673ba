// 8-point Walsh-Hadamard transform of blocks: load, compute between the loops, store. As people write it first.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_int<12> in_t;
typedef ap_int<15> out_t;

static void butterfly(out_t& a, out_t& b) {
#pragma HLS INLINE
  out_t s = a + b;
  out_t d = a - b;
  a = s;
  b = d;
}

void transform8(hls::stream<in_t>& src, hls::stream<out_t>& dst) {
#pragma HLS INTERFACE axis port = src
#pragma HLS INTERFACE axis port = dst
  out_t v[8];
#pragma HLS ARRAY_PARTITION variable = v complete

load:
  for (int i = 0; i < 8; ++i) {
#pragma HLS PIPELINE II = 1
    v[i] = src.read();
  }

  for (int half = 1; half < 8; half *= 2) {
    for (int i = 0; i < 8; ++i) {
      if ((i & half) == 0) butterfly(v[i], v[i + half]);
    }
  }

store:
  for (int i = 0; i < 8; ++i) {
#pragma HLS PIPELINE II = 1
    dst.write(v[i]);
  }
}
