// Threshold of an image of run-time size; the bounding box of the pixels above it comes back through references.
// one iteration a token of in
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<8, 1, 1, 1> pixel_in;
typedef ap_axiu<1, 1, 1, 1> pixel_out;

void bounding_box(hls::stream<pixel_in>& in, hls::stream<pixel_out>& out, unsigned short width, unsigned short height,
                  unsigned char level, unsigned short& left, unsigned short& top, unsigned short& right,
                  unsigned short& bottom, unsigned int& area) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = width
#pragma HLS INTERFACE s_axilite port = height
#pragma HLS INTERFACE s_axilite port = level
#pragma HLS INTERFACE s_axilite port = left
#pragma HLS INTERFACE s_axilite port = top
#pragma HLS INTERFACE s_axilite port = right
#pragma HLS INTERFACE s_axilite port = bottom
#pragma HLS INTERFACE s_axilite port = area
#pragma HLS INTERFACE s_axilite port = return
  unsigned short x0 = 0xffff, y0 = 0xffff, x1 = 0, y1 = 0;
  unsigned int n = 0;
  for (unsigned short y = 0; y < height; ++y) {
    for (unsigned short x = 0; x < width; ++x) {
#pragma HLS PIPELINE II = 1
      const pixel_in p = in.read();
      pixel_out q;
      const bool above = p.data > level;
      q.data = above;
      q.keep = 1;
      q.strb = 1;
      q.user = p.user;
      q.last = p.last;
      q.id = p.id;
      q.dest = p.dest;
      out.write(q);
      if (above) {
        if (x < x0) x0 = x;
        if (x > x1) x1 = x;
        if (y < y0) y0 = y;
        y1 = y;
        ++n;
      }
    }
  }
  left = x0;
  top = y0;
  right = x1;
  bottom = y1;
  area = n;
}
