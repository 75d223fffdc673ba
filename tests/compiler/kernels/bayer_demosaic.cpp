// Bilinear demosaicing of an RGGB sensor, AXI4-Stream video in and out, size at run time, the nearest pixel of the same
// colour repeated at the border (which is a reflection: the border pixel itself has another colour).
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define MAX_WIDTH 64
#define BITS 10

typedef ap_axiu<BITS, 1, 1, 1> raw_t;
typedef ap_axiu<3 * BITS, 1, 1, 1> rgb_t;
typedef ap_uint<BITS> pixel_t;

static void interpolate(pixel_t w[3][3], bool odd_row, bool odd_col, pixel_t& r, pixel_t& g, pixel_t& b) {
#pragma HLS INLINE
  const pixel_t cross = (w[0][1] + w[1][0] + w[1][2] + w[2][1] + 2) >> 2;
  const pixel_t corners = (w[0][0] + w[0][2] + w[2][0] + w[2][2] + 2) >> 2;
  const pixel_t horizontal = (w[1][0] + w[1][2] + 1) >> 1;
  const pixel_t vertical = (w[0][1] + w[2][1] + 1) >> 1;
  const pixel_t center = w[1][1];
  if (!odd_row && !odd_col) {  // a red site
    r = center;
    g = cross;
    b = corners;
  } else if (!odd_row) {  // green between reds
    r = horizontal;
    g = center;
    b = vertical;
  } else if (!odd_col) {  // green between blues
    r = vertical;
    g = center;
    b = horizontal;
  } else {
    r = corners;
    g = cross;
    b = center;
  }
}

void bayer_demosaic(hls::stream<raw_t>& raw, hls::stream<rgb_t>& rgb, ap_uint<7> width, ap_uint<7> height) {
#pragma HLS INTERFACE axis port = raw
#pragma HLS INTERFACE axis port = rgb
#pragma HLS INTERFACE s_axilite port = width
#pragma HLS INTERFACE s_axilite port = height
#pragma HLS INTERFACE s_axilite port = return
  static pixel_t buffer[2][MAX_WIDTH];
#pragma HLS ARRAY_PARTITION variable = buffer complete dim = 1
  pixel_t columns[3][3] = {};
#pragma HLS ARRAY_PARTITION variable = columns complete dim = 0

ROW:
  for (int y = 0; y <= height; y++) {
#pragma HLS LOOP_TRIPCOUNT max = 65
  COLUMN:
    for (int x = 0; x <= width; x++) {
#pragma HLS LOOP_TRIPCOUNT max = 65
#pragma HLS PIPELINE II = 1
      pixel_t incoming[3] = {columns[0][1], columns[1][1], columns[2][1]};  // right of the image: the last but one
      if (x < width) {
        incoming[0] = buffer[0][x];
        incoming[1] = buffer[1][x];
        incoming[2] = incoming[0];  // below the image: the last row but one
        if (y < height) incoming[2] = raw.read().data;
        if (y == 1) incoming[0] = incoming[2];  // above it: the second row
        buffer[0][x] = buffer[1][x];
        buffer[1][x] = incoming[2];
      }
      for (int i = 0; i < 3; i++) {
#pragma HLS UNROLL
        columns[i][0] = columns[i][1];
        columns[i][1] = columns[i][2];
        columns[i][2] = incoming[i];
      }
      if (y > 0 && x > 0) {
        pixel_t window[3][3];
        for (int i = 0; i < 3; i++)
          for (int j = 0; j < 3; j++) window[i][j] = x == 1 && j == 0 ? columns[i][2] : columns[i][j];
        pixel_t r, g, b;
        interpolate(window, (y - 1) & 1, (x - 1) & 1, r, g, b);
        rgb_t beat;
        beat.data = (b, g, r);
        beat.keep = -1;
        beat.strb = -1;
        beat.user = y == 1 && x == 1;
        beat.last = x == width;
        beat.id = 0;
        beat.dest = 0;
        rgb.write(beat);
      }
    }
  }
}
