// ap_fixed as DSP code uses it: a biquad, a table, constants, every rounding mode, saturation, division.
#include "ap_fixed.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_fixed<16, 2> sample_t;
typedef ap_fixed<18, 3> state_t;
typedef ap_fixed<12, 2, AP_RND, AP_SAT> result_t;

struct sample_pair {
  sample_t left;
  ap_ufixed<6, 4> gain;
};

static const ap_fixed<10, 1> window[8] = {0.0, 0.19, 0.61, 0.95, 0.95, 0.61, 0.19, -0.5};

template <ap_q_mode Q>
static ap_int<24> rounded(state_t v) {
  const ap_fixed<5, 3, Q, AP_SAT_SYM> shorter = v;
  return shorter.V;
}

void fixed_point(hls::stream<sample_pair>& in, hls::stream<result_t>& out, hls::stream<ap_int<24>>& modes) {
#pragma HLS PIPELINE
  static state_t kept[2];
  static ap_uint<3> at = 0;
  const sample_pair pair = in.read();
  const sample_t b0 = 0.25, a1 = -0.4;
  const state_t w = pair.left * window[at] - a1 * kept[0] - (kept[1] >> 2);
  const result_t y = b0 * w + kept[0] * ap_fixed<8, 1>(0.5) + kept[1] * b0;
  kept[1] = kept[0];
  kept[0] = w;
  ++at;
  out.write(y);
  ap_fixed<20, 8, AP_TRN_ZERO> scaled = pair.left * pair.gain;
  scaled /= ap_ufixed<4, 2>(0.75);
  scaled += 1;
  if (scaled > 0.1) scaled -= ap_fixed<8, 2>(0.375);
  modes.write(rounded<AP_TRN>(w) + 3 * rounded<AP_TRN_ZERO>(w) + 5 * rounded<AP_RND>(w) + 7 * rounded<AP_RND_ZERO>(w) +
              11 * rounded<AP_RND_MIN_INF>(w) + 13 * rounded<AP_RND_INF>(w) + 17 * rounded<AP_RND_CONV>(w) +
              scaled.to_int() * 512 + scaled.range(3, 0));
}
