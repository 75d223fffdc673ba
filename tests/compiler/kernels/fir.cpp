// A transposed-form FIR filter of 16 taps with signed coefficients: every sample costs one clock whatever the tap
// count. one iteration a token of x
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_int<12> sample_t;
typedef ap_int<10> coefficient_t;
typedef ap_int<26> sum_t;  // 12 + 10 bits a product, 4 more for sixteen of them

static const int taps = 16;
static const coefficient_t coefficients[taps] = {-5,   12,  -31, 60,  -99, 144, 201, 511,
                                                 -512, 201, 144, -99, 60,  -31, 12,  -5};

void fir(hls::stream<sample_t>& x, hls::stream<sum_t>& y) {
#pragma HLS INTERFACE axis port = x
#pragma HLS INTERFACE axis port = y
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS PIPELINE II = 1
  static sum_t partial[taps];
#pragma HLS ARRAY_PARTITION variable = partial complete dim = 1
  const sample_t sample = x.read();
  y.write(partial[0] + sample * coefficients[0]);
  for (int i = 0; i < taps - 1; ++i) {
#pragma HLS UNROLL
    partial[i] = (i + 1 < taps - 1 ? sum_t(partial[i + 1]) : sum_t(0)) + sample * coefficients[i + 1];
  }
}
