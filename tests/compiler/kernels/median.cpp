// 3x3 median of an image of run-time size; the border repeats the nearest pixel. Two line buffers and a 3x3 window.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<8> pixel_t;

const int max_width = 64;

static void order(pixel_t& a, pixel_t& b) {
#pragma HLS INLINE
  const pixel_t low = a < b ? a : b;
  const pixel_t high = a < b ? b : a;
  a = low;
  b = high;
}

static pixel_t median_of_nine(pixel_t v[9]) {
#pragma HLS INLINE
  order(v[1], v[2]);
  order(v[4], v[5]);
  order(v[7], v[8]);
  order(v[0], v[1]);
  order(v[3], v[4]);
  order(v[6], v[7]);
  order(v[1], v[2]);
  order(v[4], v[5]);
  order(v[7], v[8]);
  order(v[0], v[3]);
  order(v[5], v[8]);
  order(v[4], v[7]);
  order(v[3], v[6]);
  order(v[1], v[4]);
  order(v[2], v[5]);
  order(v[4], v[7]);
  order(v[4], v[2]);
  order(v[6], v[4]);
  order(v[4], v[2]);
  return v[4];
}

void median(hls::stream<pixel_t>& in, hls::stream<pixel_t>& out, ap_uint<7> width, ap_uint<7> height) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE s_axilite port = width
#pragma HLS INTERFACE s_axilite port = height
  static pixel_t lines[2][max_width];
#pragma HLS ARRAY_PARTITION variable = lines complete dim = 1
  pixel_t window[3][3];
#pragma HLS ARRAY_PARTITION variable = window complete dim = 0
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) window[i][j] = 0;

rows:
  for (ap_uint<8> row = 0; row < height + 1; ++row) {
#pragma HLS LOOP_TRIPCOUNT min = 1 max = 65
  columns:
    for (ap_uint<8> column = 0; column < width + 1; ++column) {
#pragma HLS LOOP_TRIPCOUNT min = 1 max = 65
#pragma HLS PIPELINE II = 1
      pixel_t newest[3];
      for (int i = 0; i < 3; ++i) newest[i] = window[i][2];  // one past the right end: repeat
      if (column < width) {
        const pixel_t above = lines[0][column];
        const pixel_t middle = lines[1][column];
        pixel_t below = middle;  // one past the bottom: repeat
        if (row < height) below = in.read();
        lines[0][column] = middle;
        lines[1][column] = below;
        newest[0] = row == 1 ? middle : above;
        newest[1] = middle;
        newest[2] = below;
      }
      for (int i = 0; i < 3; ++i) {
        window[i][0] = column == 1 ? window[i][2] : window[i][1];
        window[i][1] = window[i][2];
        window[i][2] = newest[i];
      }
      if (row > 0 && column > 0) {
        pixel_t v[9];
        for (int i = 0; i < 9; ++i) v[i] = window[i / 3][i % 3];
        out.write(median_of_nine(v));
      }
    }
  }
}
