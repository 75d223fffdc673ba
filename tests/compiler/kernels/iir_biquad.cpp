// Two second-order sections in direct form I with run-time coefficients in Q2.14; the second one's input is the first
// one's output in the same iteration. The feedback through multiplier and adders takes several clocks: II says how
// many.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axis<16, 0, 0, 0> audio_t;
typedef ap_int<16> coef_t;

struct section_t {
  coef_t b0, b1, b2, a1, a2;
};

class biquad {
 public:
  biquad() : x1(0), x2(0), y1(0), y2(0) {}

  ap_int<16> step(ap_int<16> x, const section_t& c) {
#pragma HLS INLINE
    ap_int<36> acc = c.b0 * x + c.b1 * x1 + c.b2 * x2;
    acc -= c.a1 * y1;
    acc -= c.a2 * y2;
    acc += 1 << 13;  // round
    acc >>= 14;
    ap_int<16> y;
    if (acc > 32767)
      y = 32767;
    else if (acc < -32768)
      y = -32768;
    else
      y = acc;
    x2 = x1;
    x1 = x;
    y2 = y1;
    y1 = y;
    return y;
  }

 private:
  ap_int<16> x1, x2, y1, y2;
};

void iir_biquad(hls::stream<audio_t>& in, hls::stream<audio_t>& out, section_t first, section_t second) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = first
#pragma HLS INTERFACE s_axilite port = second
#pragma HLS INTERFACE s_axilite port = return
  biquad sections[2];
#pragma HLS ARRAY_PARTITION variable = sections complete
  audio_t beat;
  do {
#pragma HLS PIPELINE II = 6
    beat = in.read();
    const ap_int<16> middle = sections[0].step(beat.data, first);
    beat.data = sections[1].step(middle, second);
    out.write(beat);
  } while (!beat.last);
}
