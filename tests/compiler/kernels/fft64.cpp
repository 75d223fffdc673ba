// 64-point FFT, radix 2, decimation in frequency: six stages, each with a delay line of half its span (single-path
// delay feedback), one complex sample a clock for ever. Every stage halves: samples within the circle of 32767 never
// overflow. Spectra come out in bit-reversed order, 63 samples late.
#include "ap_int.h"
#include "hls_stream.h"

#define FFT_STAGES 6
#define FFT_LENGTH (1 << FFT_STAGES)

typedef ap_int<16> sample_t;
typedef ap_int<18> twiddle_t;

struct complex_t {
  sample_t re;
  sample_t im;
};

// exp(-2 pi i k / 64) = cosine[k] - i sine[k], times 32767
static const short cosine[FFT_LENGTH / 2] = {32767,  32609,  32137,  31356,  30273,  28898,  27245,  25329,
                                             23170,  20787,  18204,  15446,  12539,  9512,   6393,   3212,
                                             0,      -3212,  -6393,  -9512,  -12539, -15446, -18204, -20787,
                                             -23170, -25329, -27245, -28898, -30273, -31356, -32137, -32609};
static const short sine[FFT_LENGTH / 2] = {0,     3212,  6393,  9512,  12539, 15446, 18204, 20787, 23170, 25329, 27245,
                                           28898, 30273, 31356, 32137, 32609, 32767, 32609, 32137, 31356, 30273, 28898,
                                           27245, 25329, 23170, 20787, 18204, 15446, 12539, 9512,  6393,  3212};

static complex_t rotate(complex_t x, int k) {
#pragma HLS INLINE
  const ap_int<34> re = x.re * cosine[k] + x.im * sine[k] + (1 << 14);
  const ap_int<34> im = x.im * cosine[k] - x.re * sine[k] + (1 << 14);
  complex_t y;
  y.re = re >> 15;
  y.im = im >> 15;
  return y;
}

template <int STAGE>
void fft_stage(hls::stream<complex_t>& in, hls::stream<complex_t>& out) {
#pragma HLS PIPELINE II = 1
  const int SPAN = FFT_LENGTH >> (STAGE + 1);
  static complex_t delay[SPAN];
  static ap_uint<FFT_STAGES - STAGE> count = 0;

  const complex_t x = in.read();
  const int k = count % SPAN;
  const complex_t old = delay[k];
  if (count < SPAN) {
    out.write(rotate(old, k << STAGE));
    delay[k] = x;
  } else {
    complex_t sum, difference;
    sum.re = (old.re + x.re) >> 1;
    sum.im = (old.im + x.im) >> 1;
    difference.re = (old.re - x.re) >> 1;
    difference.im = (old.im - x.im) >> 1;
    out.write(sum);
    delay[k] = difference;
  }
  count++;
}

void fft64(hls::stream<complex_t>& samples, hls::stream<complex_t>& spectrum) {
#pragma HLS INTERFACE axis port = samples
#pragma HLS INTERFACE axis port = spectrum
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS DATAFLOW
  hls::stream<complex_t> s[FFT_STAGES - 1];
#pragma HLS STREAM variable = s depth = 4
  fft_stage<0>(samples, s[0]);
  fft_stage<1>(s[0], s[1]);
  fft_stage<2>(s[1], s[2]);
  fft_stage<3>(s[2], s[3]);
  fft_stage<4>(s[3], s[4]);
  fft_stage<5>(s[4], spectrum);
}
