// Histogram equalisation of a frame: the first pass stores the frame and counts its values, then the counts are summed
// up and made into a table of new values, the second pass maps the frame.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

// 640 and 480 on a board; the tests are faster with less.
#ifndef FRAME_WIDTH
#define FRAME_WIDTH 32
#define FRAME_HEIGHT 16
#endif
#define FRAME_SIZE (FRAME_WIDTH * FRAME_HEIGHT)
#define BINS 64  // pixels of six bits

typedef ap_axiu<8, 1, 0, 0> video_t;
typedef ap_uint<6> gray_t;
typedef ap_uint<20> count_t;

void histogram_equalization(hls::stream<video_t>& in, hls::stream<video_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
  static gray_t frame[FRAME_HEIGHT][FRAME_WIDTH];
  static count_t histogram[BINS];
  static gray_t mapping[BINS];
#pragma HLS RESOURCE variable = frame core = RAM_2P_BRAM

clear:
  for (int i = 0; i < BINS; i++) {
#pragma HLS PIPELINE II = 1
    histogram[i] = 0;
  }

first_pass:
  for (int y = 0; y < FRAME_HEIGHT; y++) {
    for (int x = 0; x < FRAME_WIDTH; x++) {
#pragma HLS PIPELINE II = 1
      const video_t beat = in.read();
      const gray_t v = beat.data >> 2;
      frame[y][x] = v;
      histogram[v]++;
    }
  }

  count_t sum = 0;
  count_t below = 0;  // of the smallest value that occurs
  bool found = false;
accumulate:
  for (int i = 0; i < BINS; i++) {
#pragma HLS PIPELINE II = 1
    const count_t n = histogram[i];
    sum += n;
    if (!found && n != 0) {
      below = n;
      found = true;
    }
    count_t range = FRAME_SIZE - below;
    if (range == 0) range = 1;
    const count_t above = found ? count_t(sum - below) : count_t(0);
    mapping[i] = (above * (BINS - 1) + range / 2) / range;
  }

second_pass:
  for (int y = 0; y < FRAME_HEIGHT; y++) {
    for (int x = 0; x < FRAME_WIDTH; x++) {
#pragma HLS PIPELINE II = 1
      const gray_t v = mapping[frame[y][x]];
      video_t beat;
      beat.data = (v, v.range(5, 4));
      beat.keep = 1;
      beat.strb = 1;
      beat.user = x == 0 && y == 0;
      beat.last = x == FRAME_WIDTH - 1;
      out.write(beat);
    }
  }
}
