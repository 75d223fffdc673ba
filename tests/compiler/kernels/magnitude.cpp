// Magnitude of a complex number, limited and rounded, by hls_math.h on integers and fixed point; one iteration a token
#include "ap_fixed.h"
#include "ap_int.h"
#include "hls_math.h"
#include "hls_stream.h"

typedef ap_fixed<18, 10> part_t;

struct complex_t {
  ap_int<18> re, im;
};
struct polar_t {
  ap_uint<18> length;
  ap_int<18> larger;
  ap_int<18> rounded;
  ap_uint<1> left;
};

void magnitude(hls::stream<complex_t>& in, hls::stream<polar_t>& out, ap_uint<18> limit) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
  for (int i = 0; i < 8; ++i) {
#pragma HLS PIPELINE
    const complex_t z = in.read();
    part_t re, im;
    re.range(17, 0) = z.re;
    im.range(17, 0) = z.im;
    const ap_ufixed<38, 22> power = re * re + im * im;
    const ap_ufixed<18, 10> length = hls::sqrt(power);
    polar_t p;
    p.length = hls::min(ap_uint<18>(length.range(17, 0)), limit);
    p.larger = hls::max(hls::abs(re), hls::abs(im)).range(17, 0);
    p.rounded = hls::floor(re).range(17, 0) + hls::ceil(im).range(17, 0) + hls::round(part_t(re >> 1)).range(17, 0);
    p.left = hls::signbit(re);
    out.write(p);
  }
}
