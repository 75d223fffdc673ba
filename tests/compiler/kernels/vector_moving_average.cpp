// The mean of the last four vectors of four channels, and their sum over the channels, with hls::vector: one iteration
// a token
#include "ap_int.h"
#include "hls_stream.h"
#include "hls_vector.h"

typedef hls::vector<ap_uint<12>, 4> beat_t;
typedef hls::vector<ap_uint<14>, 4> sums_t;

void vector_moving_average(hls::stream<beat_t>& in, hls::stream<beat_t>& mean, hls::stream<ap_uint<16>>& total) {
#pragma HLS PIPELINE II = 1
  static beat_t past[4];
#pragma HLS ARRAY_PARTITION variable = past complete
  const beat_t now = in.read();
  sums_t sums(0);
  for (int i = 3; i > 0; --i) past[i] = past[i - 1];
  past[0] = now;
  for (int i = 0; i < 4; ++i) {
    sums_t wide;
    for (int channel = 0; channel < 4; ++channel) wide[channel] = past[i][channel];
    sums += wide;
  }
  sums = (sums + 2) >> 2;
  beat_t result;
  for (int channel = 0; channel < 4; ++channel) result[channel] = sums[channel];
  mean.write(result);
  const hls::vector<ap_uint<16>, 4> wide = {now[0], now[1], now[2], now[3]};
  total.write(wide.reduce_add());
}
