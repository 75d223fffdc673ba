// The largest value seen in each of 64 channels; the write's condition depends on the word read (not only its data).
// one iteration a token of samples
#include "ap_int.h"
#include "hls_stream.h"

struct sample_t {
  ap_uint<6> channel;
  ap_int<10> value;
};

void peak_hold(hls::stream<sample_t>& samples, hls::stream<ap_int<10>>& peaks) {
#pragma HLS PIPELINE II = 1
  static ap_int<10> peak[64] = {0};
  const sample_t s = samples.read();
  const ap_int<10> before = peak[s.channel];
  if (s.value > before) peak[s.channel] = s.value;
  peaks.write(before);
}
