// 8-bit RGB to YUV (BT.601, studio range) with rounding; struct payloads with constructors, template helpers.
// one iteration a token of yuv
#include "ap_int.h"
#include "hls_stream.h"

struct rgb_t {
  ap_uint<8> r, g, b;
  rgb_t() : r(0), g(0), b(0) {}
  rgb_t(ap_uint<8> r_, ap_uint<8> g_, ap_uint<8> b_) : r(r_), g(g_), b(b_) {}
};

struct yuv_t {
  ap_uint<8> y, u, v;
  yuv_t() : y(0), u(0), v(0) {}
  yuv_t(ap_uint<8> y_, ap_uint<8> u_, ap_uint<8> v_) : y(y_), u(u_), v(v_) {}
};

template <int LOW, int HIGH, typename T>
static ap_uint<8> clip(const T value) {
#pragma HLS INLINE
  if (value < LOW) return LOW;
  if (value > HIGH) return HIGH;
  return value;
}

static yuv_t convert(const rgb_t& p) {
#pragma HLS INLINE
  const ap_int<18> y = 66 * p.r + 129 * p.g + 25 * p.b + 128;
  const ap_int<18> u = -38 * p.r - 74 * p.g + 112 * p.b + 128;
  const ap_int<18> v = 112 * p.r - 94 * p.g - 18 * p.b + 128;
  return yuv_t(clip<16, 235>((y >> 8) + 16), clip<16, 240>((u >> 8) + 128), clip<16, 240>((v >> 8) + 128));
}

void rgb_to_yuv(hls::stream<rgb_t>& rgb, hls::stream<yuv_t>& yuv, unsigned short pixels) {
#pragma HLS INTERFACE axis port = rgb
#pragma HLS INTERFACE axis port = yuv
#pragma HLS INTERFACE s_axilite port = pixels
  for (unsigned short i = 0; i < pixels; i++) {
#pragma HLS PIPELINE II = 1
    yuv.write(convert(rgb.read()));
  }
}
