// Product of two 8x8 matrices in local arrays that are partitioned cyclically and in blocks; one iteration a token
#include "ap_int.h"
#include "hls_stream.h"
const int N = 8;
typedef ap_int<8> in_t;
typedef ap_int<20> out_t;
static void load(hls::stream<in_t>& in, in_t a[N][N]) {
#pragma HLS ARRAY_PARTITION variable = a cyclic factor = 4 dim = 2
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
#pragma HLS PIPELINE II = 1
      a[i][j] = in.read();
    }
}
void banked_matrix(hls::stream<in_t>& in, hls::stream<out_t>& out) {
  in_t a[N][N], b[N][N];
#pragma HLS ARRAY_PARTITION variable = a cyclic factor = 4 dim = 2
#pragma HLS ARRAY_PARTITION variable = b block factor = 4 dim = 1
  load(in, a);
  load(in, b);
row:
  for (int i = 0; i < N; i++) {
  col:
    for (int j = 0; j < N; j++) {
#pragma HLS PIPELINE II = 1
      out_t sum = 0;
      for (int k = 0; k < N; k++) sum += a[i][k] * b[k][j];
      out.write(sum);
    }
  }
}
