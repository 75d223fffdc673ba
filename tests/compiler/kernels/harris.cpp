// Harris corners of 8-bit video: Sobel gradients, their products, sums over 3x3, det - trace^2 / 16, each a process.
// One image width and height for all, the two rows and columns at each border have no response.
#include "ap_int.h"
#include "hls_stream.h"

#define MAX_WIDTH 128

typedef ap_uint<8> pixel_t;
typedef ap_int<11> gradient_t;
typedef ap_int<48> response_t;

struct gradients_t {
  gradient_t x, y;
};
struct tensor_t {
  ap_uint<21> xx, yy;
  ap_int<22> xy;
};
struct sums_t {
  ap_uint<25> xx, yy;
  ap_int<26> xy;
};

// Rows above the newest pixel, shifted by one column a step; what lies outside of the image is zero.
template <typename T, int SIZE>
struct neighborhood {
  T lines[SIZE - 1][MAX_WIDTH];
  T window[SIZE][SIZE];

  void shift(const T& incoming, int x, int y) {
#pragma HLS INLINE
    T column[SIZE];
    for (int i = 0; i < SIZE - 1; i++) {
#pragma HLS UNROLL
      if (y >= SIZE - 1 - i)
        column[i] = lines[i][x];
      else
        column[i] = T();
    }
    column[SIZE - 1] = incoming;
    for (int i = 0; i < SIZE - 1; i++) {
#pragma HLS UNROLL
      lines[i][x] = column[i + 1];
    }
    for (int i = 0; i < SIZE; i++) {
#pragma HLS UNROLL
      for (int j = 0; j < SIZE - 1; j++) window[i][j] = window[i][j + 1];
      window[i][SIZE - 1] = column[i];
    }
  }
};

static void sobel_stage(hls::stream<pixel_t>& in, hls::stream<gradients_t>& out, ap_uint<7> width, ap_uint<7> height) {
  neighborhood<pixel_t, 3> n;
#pragma HLS ARRAY_PARTITION variable = n.lines complete dim = 1
#pragma HLS ARRAY_PARTITION variable = n.window complete dim = 0
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
#pragma HLS PIPELINE II = 1
#pragma HLS LOOP_FLATTEN
      n.shift(in.read(), x, y);
      const pixel_t(&w)[3][3] = n.window;
      gradients_t g;
      g.x = 0;
      g.y = 0;
      if (x >= 2 && y >= 2) {
        g.x = (w[0][2] - w[0][0]) + 2 * (w[1][2] - w[1][0]) + (w[2][2] - w[2][0]);
        g.y = (w[2][0] - w[0][0]) + 2 * (w[2][1] - w[0][1]) + (w[2][2] - w[0][2]);
      }
      out.write(g);
    }
  }
}

static void tensor_stage(hls::stream<gradients_t>& in, hls::stream<tensor_t>& out, ap_uint<7> width,
                         ap_uint<7> height) {
  for (int i = 0; i < width * height; i++) {
#pragma HLS PIPELINE II = 1
    const gradients_t g = in.read();
    tensor_t t;
    t.xx = g.x * g.x;
    t.yy = g.y * g.y;
    t.xy = g.x * g.y;
    out.write(t);
  }
}

static void sum_stage(hls::stream<tensor_t>& in, hls::stream<sums_t>& out, ap_uint<7> width, ap_uint<7> height) {
  neighborhood<tensor_t, 3> n;
#pragma HLS ARRAY_PARTITION variable = n.lines complete dim = 1
#pragma HLS ARRAY_PARTITION variable = n.window complete dim = 0
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
#pragma HLS PIPELINE II = 1
      n.shift(in.read(), x, y);
      sums_t s = {0, 0, 0};
      for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
          s.xx += n.window[i][j].xx;
          s.yy += n.window[i][j].yy;
          s.xy += n.window[i][j].xy;
        }
      }
      if (x < 4 || y < 4) s.xx = s.yy = s.xy = 0;
      out.write(s);
    }
  }
}

static void response_stage(hls::stream<sums_t>& in, hls::stream<response_t>& out, ap_uint<7> width, ap_uint<7> height) {
  for (int i = 0; i < width * height; i++) {
#pragma HLS PIPELINE II = 1
    const sums_t s = in.read();
    const ap_uint<26> trace = s.xx + s.yy;
    const ap_int<52> determinant = s.xx * s.yy - s.xy * s.xy;
    response_t r = (determinant - ((trace * trace) >> 4)) >> 4;
    out.write(r);
  }
}

void harris(hls::stream<pixel_t>& image, hls::stream<response_t>& response, ap_uint<7> width, ap_uint<7> height) {
#pragma HLS INTERFACE axis port = image
#pragma HLS INTERFACE axis port = response
#pragma HLS INTERFACE s_axilite port = width
#pragma HLS INTERFACE s_axilite port = height
#pragma HLS INTERFACE s_axilite port = return
#pragma HLS DATAFLOW
  hls::stream<gradients_t> gradients("gradients");
  hls::stream<tensor_t> tensors("tensors");
  hls::stream<sums_t> sums("sums");
  sobel_stage(image, gradients, width, height);
  tensor_stage(gradients, tensors, width, height);
  sum_stage(tensors, sums, width, height);
  response_stage(sums, response, width, height);
}
