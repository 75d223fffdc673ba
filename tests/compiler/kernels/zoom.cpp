// Enlarges an image of run-time size by a run-time whole factor: every pixel is read once, lines repeat from a buffer.
// one iteration a token of out
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<10> pixel_t;

void zoom(hls::stream<pixel_t>& in, hls::stream<pixel_t>& out, ap_uint<6> width, ap_uint<6> height, ap_uint<3> factor) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = width
#pragma HLS INTERFACE s_axilite port = height
#pragma HLS INTERFACE s_axilite port = factor
  pixel_t line[64];
  pixel_t current = 0;
Rows:
  for (ap_uint<6> y = 0; y < height; y++) {
  RepeatRow:
    for (ap_uint<3> repeat = 0; repeat < factor; repeat++) {
    Columns:
      for (ap_uint<6> x = 0; x < width; x++) {
      RepeatPixel:
        for (ap_uint<3> k = 0; k < factor; k++) {
#pragma HLS PIPELINE II = 1
          if (k == 0) {
            if (repeat == 0) {
              current = in.read();
              line[x] = current;
            } else {
              current = line[x];
            }
          }
          out.write(current);
        }
      }
    }
  }
}
