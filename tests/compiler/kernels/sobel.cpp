// Sobel gradient magnitude |gx| + |gy|, saturated to 8 bits; the outermost pixels are 0. AXI4-Stream video in and out.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define MAX_COLS 128

typedef ap_axiu<8, 1, 1, 1> video_t;

template <typename T>
T absolute(T v) {
#pragma HLS INLINE
  return v < 0 ? T(-v) : v;
}

void sobel(hls::stream<video_t>& src, hls::stream<video_t>& dst, int rows, int cols) {
#pragma HLS INTERFACE axis register both port = src
#pragma HLS INTERFACE axis register both port = dst
#pragma HLS INTERFACE s_axilite port = rows bundle = CONTROL
#pragma HLS INTERFACE s_axilite port = cols bundle = CONTROL
#pragma HLS INTERFACE s_axilite port = return bundle = CONTROL
  ap_uint<8> line_buf[2][MAX_COLS];
#pragma HLS ARRAY_PARTITION variable = line_buf complete dim = 1
  ap_uint<8> win[3][3];
#pragma HLS ARRAY_PARTITION variable = win complete dim = 0

  for (int i = 0; i < rows + 1; i++) {
#pragma HLS LOOP_TRIPCOUNT min = 2 max = 129
    for (int j = 0; j < cols + 1; j++) {
#pragma HLS LOOP_TRIPCOUNT min = 2 max = 129
#pragma HLS LOOP_FLATTEN off
#pragma HLS PIPELINE II = 1
      ap_uint<8> px = 0;
      if (i < rows && j < cols) {
        video_t beat;
        src >> beat;
        px = beat.data;
      }
      ap_uint<8> c0 = 0, c1 = 0;
      if (j < cols) {
        c0 = line_buf[0][j];
        c1 = line_buf[1][j];
        line_buf[0][j] = c1;
        line_buf[1][j] = px;
      }
      for (int r = 0; r < 3; r++) {
        win[r][0] = win[r][1];
        win[r][1] = win[r][2];
      }
      win[0][2] = c0;
      win[1][2] = c1;
      win[2][2] = px;
      if (i > 0 && j > 0) {
        const int y = i - 1, x = j - 1;
        ap_uint<8> magnitude = 0;
        if (y > 0 && y < rows - 1 && x > 0 && x < cols - 1) {
          ap_int<11> gx = (win[0][2] + 2 * win[1][2] + win[2][2]) - (win[0][0] + 2 * win[1][0] + win[2][0]);
          ap_int<11> gy = (win[2][0] + 2 * win[2][1] + win[2][2]) - (win[0][0] + 2 * win[0][1] + win[0][2]);
          ap_uint<12> sum = absolute(gx) + absolute(gy);
          magnitude = sum > 255 ? ap_uint<8>(255) : ap_uint<8>(sum);
        }
        video_t beat;
        beat.data = magnitude;
        beat.keep = -1;
        beat.strb = -1;
        beat.user = (y == 0 && x == 0);
        beat.last = (x == cols - 1);
        beat.id = 0;
        beat.dest = 0;
        dst << beat;
      }
    }
  }
}
