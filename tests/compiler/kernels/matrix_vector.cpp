// y = A x for an 8x8 matrix of weights in a ROM; the vector is read once, one product a clock.
#include "ap_int.h"
#include "hls_stream.h"

const int N = 8;

static const signed char weights[N][N] = {{12, -7, 33, 0, 1, -128, 127, 5},
                                          {-1, -2, -3, -4, -5, -6, -7, -8},
                                          {64, 32, 16, 8, 4, 2, 1, 0},
                                          {9, 8, 7, 6, 5, 4, 3, 2},
                                          {-100, 100, -100, 100, -50, 50, -25, 25},
                                          {1, 0, 0, 0, 0, 0, 0, -1},
                                          {17, 23, -29, 31, -37, 41, -43, 47},
                                          {127, 127, 127, 127, 127, 127, 127, 127}};

void matrix_vector(hls::stream<ap_int<8>>& x, hls::stream<ap_int<19>>& y) {
#pragma HLS INTERFACE axis port = x
#pragma HLS INTERFACE axis port = y
  ap_int<8> vector[N];
load:
  for (int j = 0; j < N; j++) {
#pragma HLS PIPELINE II = 1
    vector[j] = x.read();
  }
row:
  for (int i = 0; i < N; i++) {
    ap_int<19> acc = 0;
  column:
    for (int j = 0; j < N; j++) {
#pragma HLS PIPELINE II = 1
      acc += weights[i][j] * vector[j];
      if (j == N - 1) y.write(acc);
    }
  }
}
