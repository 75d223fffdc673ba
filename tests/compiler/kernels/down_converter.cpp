// Digital down converter: a numerically controlled oscillator (quarter wave in ROM, 24-bit phase) mixes the samples to
// baseband, a third-order CIC filter decimates both parts by sixteen.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define DECIMATION 16
#define ORDER 3

typedef ap_int<12> sample_t;
typedef ap_int<36> accumulator_t;  // 24 bits of product, 12 of growth

struct baseband_t {
  ap_int<16> i;
  ap_int<16> q;
};

// sin((k + 1/2) pi / 128) * 2047
static const ap_uint<11> quarter_wave[64] = {
    25,   75,   126,  176,  226,  275,  325,  375,  424,  473,  522,  570,  618,  666,  713,  760,
    807,  852,  898,  943,  987,  1031, 1074, 1116, 1158, 1199, 1239, 1279, 1318, 1356, 1393, 1430,
    1465, 1500, 1533, 1566, 1598, 1629, 1659, 1688, 1716, 1743, 1769, 1793, 1817, 1840, 1861, 1881,
    1901, 1919, 1936, 1951, 1966, 1979, 1992, 2003, 2012, 2021, 2028, 2035, 2039, 2043, 2046, 2047};

// `phase` in 1/256 turns.
static ap_int<12> sine(ap_uint<8> phase) {
#pragma HLS INLINE
  const ap_uint<6> within = phase.range(5, 0);
  const ap_uint<6> index = phase[6] ? ap_uint<6>(~within) : within;
  const ap_int<12> magnitude = quarter_wave[index];
  return phase[7] ? ap_int<12>(-magnitude) : magnitude;
}

class cic_decimator {
  accumulator_t integrators[ORDER];
  accumulator_t combs[ORDER];

 public:
  cic_decimator() {
#pragma HLS ARRAY_PARTITION variable = integrators complete
#pragma HLS ARRAY_PARTITION variable = combs complete
    for (int k = 0; k < ORDER; k++) {
      integrators[k] = 0;
      combs[k] = 0;
    }
  }
  // Each integrator adds what the one before had a clock ago: three short adders instead of a long one.
  void integrate(ap_int<24> x) {
#pragma HLS INLINE
    for (int k = ORDER - 1; k > 0; k--) {
#pragma HLS UNROLL
      integrators[k] += integrators[k - 1];
    }
    integrators[0] += x;
  }
  ap_int<16> comb() {
#pragma HLS INLINE
    accumulator_t v = integrators[ORDER - 1];
    for (int k = 0; k < ORDER; k++) {
#pragma HLS UNROLL
      const accumulator_t before = combs[k];
      combs[k] = v;
      v = v - before;
    }
    return v >> 20;
  }
};

void down_converter(hls::stream<sample_t>& samples, hls::stream<baseband_t>& baseband, ap_uint<24> frequency,
                    ap_uint<16> count) {
#pragma HLS INTERFACE axis port = samples
#pragma HLS INTERFACE axis port = baseband
#pragma HLS INTERFACE s_axilite port = frequency
#pragma HLS INTERFACE s_axilite port = count
#pragma HLS INTERFACE s_axilite port = return
  cic_decimator i_filter, q_filter;
  ap_uint<24> phase = 0;
  for (ap_uint<16> n = 0; n < count; n++) {
    for (int k = 0; k < DECIMATION; k++) {
#pragma HLS PIPELINE II = 1
      const sample_t x = samples.read();
      const ap_uint<8> turn = phase >> 16;
      const ap_int<24> i = x * sine(turn + 64);
      const ap_int<24> q = -(x * sine(turn));
      phase += frequency;
      i_filter.integrate(i);
      q_filter.integrate(q);
      if (k == DECIMATION - 1) {
        baseband_t b;
        b.i = i_filter.comb();
        b.q = q_filter.comb();
        baseband.write(b);
      }
    }
  }
}
