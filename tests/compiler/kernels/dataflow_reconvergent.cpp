// Fork and join: the pixel itself waits for a slow way through a divider beside it. A stream of every second pixel's
// quality goes around both.
#include "ap_int.h"
#include "hls_stream.h"

struct pixel_t {
  ap_uint<8> level;
  ap_int<9> change;
};

static void split(hls::stream<pixel_t>& in, hls::stream<pixel_t>& straight, hls::stream<pixel_t>& to_divide,
                  hls::stream<ap_uint<1>>& marks, ap_uint<10> count) {
  for (unsigned i = 0; i < count; i++) {
#pragma HLS PIPELINE
    pixel_t p = in.read();
    straight.write(p);
    to_divide.write(p);
    if (i % 2 == 0) marks.write(p.change < 0);
  }
}

static void divide(hls::stream<pixel_t>& pixels, hls::stream<ap_int<17>>& quotients, ap_uint<10> count) {
  for (unsigned i = 0; i < count; i++) {
#pragma HLS PIPELINE
    pixel_t p = pixels.read();
    quotients.write((ap_int<17>(p.change) * 256) / (p.level + 1));
  }
}

static void join(hls::stream<pixel_t>& straight, hls::stream<ap_int<17>>& quotients, hls::stream<ap_uint<1>>& marks,
                 hls::stream<ap_int<18>>& out, ap_uint<10> count) {
  ap_uint<1> mark = 0;
  for (unsigned i = 0; i < count; i++) {
#pragma HLS PIPELINE
    pixel_t p = straight.read();
    ap_int<17> q = quotients.read();
    if (i % 2 == 0) mark = marks.read();
    out.write(mark ? ap_int<18>(q - p.level) : ap_int<18>(q + p.level));
  }
}

void dataflow_reconvergent(hls::stream<pixel_t>& in, hls::stream<ap_int<18>>& out, ap_uint<10> count) {
#pragma HLS DATAFLOW
  hls::stream<pixel_t, 64> straight("straight");
  hls::stream<pixel_t> to_divide;
  hls::stream<ap_int<17>, 4> quotients;
  hls::stream<ap_uint<1>> marks;
#pragma HLS STREAM variable = marks depth = 40
  split(in, straight, to_divide, marks, count);
  divide(to_divide, quotients, count);
  join(straight, quotients, marks, out, count);
}
