// Overlays a picture with transparency on video: where the rectangle at (left, top) lies, the overlay's stream is read
// and mixed, elsewhere the video passes. The result of each channel is exact, rounded division by 255.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<24, 1, 1, 1> video_t;
typedef ap_axiu<32, 1, 1, 1> overlay_t;

struct rectangle_t {
  ap_uint<12> left, top, width, height;

  bool contains(ap_uint<12> x, ap_uint<12> y) const {
#pragma HLS INLINE
    return x >= left && y >= top && x < left + width && y < top + height;
  }
};

static inline ap_uint<8> mix(ap_uint<8> below, ap_uint<8> above, ap_uint<8> alpha) {
#pragma HLS INLINE
  const ap_uint<16> t = above * alpha + below * ap_uint<8>(255 - alpha) + 127;
  return t / 255;
}

void alpha_blend(hls::stream<video_t>& video, hls::stream<overlay_t>& overlay, hls::stream<video_t>& out,
                 ap_uint<12> cols, ap_uint<12> rows, rectangle_t where) {
#pragma HLS INTERFACE axis port = video
#pragma HLS INTERFACE axis port = overlay
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = cols
#pragma HLS INTERFACE s_axilite port = rows
#pragma HLS INTERFACE s_axilite port = where
#pragma HLS INTERFACE s_axilite port = return
  for (ap_uint<12> y = 0; y < rows; ++y) {
    for (ap_uint<12> x = 0; x < cols; ++x) {
#pragma HLS PIPELINE II = 1
      video_t v = video.read();
      if (where.contains(x, y)) {
        const overlay_t o = overlay.read();
        const ap_uint<8> alpha = o.data(31, 24);
        for (int c = 0; c < 3; ++c) {
#pragma HLS UNROLL
          v.data(8 * c + 7, 8 * c) = mix(v.data(8 * c + 7, 8 * c), o.data(8 * c + 7, 8 * c), alpha);
        }
      }
      out.write(v);
    }
  }
}
