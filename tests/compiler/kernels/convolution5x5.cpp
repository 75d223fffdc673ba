// Convolution with a 5x5 kernel given at run time; templates for type, size and border. The border is zero, the result
// is rounded, shifted and saturated. Video as AXI4-Stream beats, two pixels in each.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

#define MAX_WIDTH 64

typedef ap_axiu<16, 1, 0, 0> video_t;

struct weights_t {
  ap_int<6> w[5][5];
  ap_uint<4> shift;
};

template <int K, int PER_CLOCK, int WIDTH>
class filter2d {
 public:
  typedef ap_uint<8> pixel;
  typedef ap_uint<8 * PER_CLOCK> group;

  void run(hls::stream<video_t>& in, hls::stream<video_t>& out, const weights_t& weights, int rows, int cols) {
#pragma HLS ARRAY_PARTITION variable = lines complete dim = 1
#pragma HLS ARRAY_PARTITION variable = window complete dim = 0
    const int half = K / 2;
    const int groups = cols / PER_CLOCK;
    const int late = (half + PER_CLOCK - 1) / PER_CLOCK;  // groups by which the output is later within its row
  rows_loop:
    for (int y = 0; y < rows + half; y++) {
    columns_loop:
      for (int g = 0; g < groups + late; g++) {
#pragma HLS PIPELINE II = 1
        group column[K];
#pragma HLS ARRAY_PARTITION variable = column complete
        for (int k = 0; k < K; k++) column[k] = 0;
        if (g < groups) {
          if (y < rows) column[K - 1] = in.read().data;
          for (int k = 0; k < K - 1; k++) {
            const group above = lines[k][g];
            if (y >= K - 1 - k) column[k] = above;
          }
          for (int k = 0; k < K - 1; k++) lines[k][g] = column[k + 1];
        }
        shift_in(column);
        if (y >= half && g >= late) {
          video_t beat;
          for (int p = 0; p < PER_CLOCK; p++) {
            // The window of pixel p of the group `late` groups ago.
            beat.data.range(8 * p + 7, 8 * p) = at(weights, window_width - PER_CLOCK * (late + 1) + p - half);
          }
          beat.keep = -1;
          beat.strb = -1;
          beat.user = y == half && g == late;
          beat.last = g == groups + late - 1;
          out.write(beat);
        }
      }
    }
  }

 private:
  static const int late_groups = (K / 2 + PER_CLOCK - 1) / PER_CLOCK;
  static const int window_width = PER_CLOCK * (2 * late_groups + 1);

  void shift_in(const group column[K]) {
#pragma HLS INLINE
    for (int k = 0; k < K; k++) {
      for (int i = 0; i < window_width - PER_CLOCK; i++) window[k][i] = window[k][i + PER_CLOCK];
      for (int p = 0; p < PER_CLOCK; p++) {
        window[k][window_width - PER_CLOCK + p] = column[k].range(8 * p + 7, 8 * p);
      }
    }
  }
  pixel at(const weights_t& weights, int first) const {
#pragma HLS INLINE
    ap_int<20> sum = (1 << weights.shift) >> 1;
    for (int i = 0; i < K; i++)
      for (int j = 0; j < K; j++) sum += weights.w[i][j] * window[i][first + j];
    sum >>= weights.shift;
    if (sum < 0) return 0;
    if (sum > 255) return 255;
    return sum;
  }

  group lines[K - 1][WIDTH / PER_CLOCK];
  pixel window[K][window_width];
};

void convolution5x5(hls::stream<video_t>& src, hls::stream<video_t>& dst, weights_t weights, int rows, int cols) {
#pragma HLS INTERFACE axis port = src
#pragma HLS INTERFACE axis port = dst
#pragma HLS INTERFACE s_axilite port = weights bundle = control
#pragma HLS INTERFACE s_axilite port = rows bundle = control
#pragma HLS INTERFACE s_axilite port = cols bundle = control
#pragma HLS INTERFACE s_axilite port = return bundle = control
  static filter2d<5, 2, MAX_WIDTH> filter;
  filter.run(src, dst, weights, rows, cols);
}
