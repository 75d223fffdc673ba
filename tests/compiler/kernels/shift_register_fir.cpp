// A FIR filter whose samples stand in an ap_shift_reg, as vendors' examples write it; a second, long register that is
// read at an address known at run time adds an echo. One iteration a token of x
#include "ap_int.h"
#include "ap_shift_reg.h"
#include "hls_stream.h"

typedef ap_int<12> sample_t;

struct filter_config {
  static const int taps = 8;
  static const int shift = 6;
  static const unsigned longest_echo = 100;
};

static const ap_int<8> coefficients[filter_config::taps] = {-3, 11, 45, 75, 75, 45, 11, -3};

void shift_register_fir(hls::stream<sample_t>& x, hls::stream<ap_int<16>>& y, ap_uint<7> echo) {
#pragma HLS INTERFACE axis port = x
#pragma HLS INTERFACE axis port = y
  static ap_shift_reg<sample_t, filter_config::taps> samples;
  static ap_shift_reg<ap_int<16>, filter_config::longest_echo> past("past");
  for (int n = 0; n < 16; ++n) {
#pragma HLS PIPELINE II = 1
    samples.shift(x.read());
    ap_int<24> sum = 0;
    for (int i = 0; i < filter_config::taps; ++i) {
#pragma HLS UNROLL
      sum += samples.read(i) * coefficients[i];
    }
    const ap_int<16> now = sum >> filter_config::shift;
    const ap_int<16> then = past.shift(now, echo < filter_config::longest_echo ? unsigned(echo) : 0u);
    y.write(now + (then >> 1));
  }
}
