// A loop over frames around the calls, a stage that may be left out, and the object of a class as a stage.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<8> pixel_t;

static void first(hls::stream<pixel_t>& in, hls::stream<pixel_t>& lines, hls::stream<ap_uint<16>>& sums, int length) {
  ap_uint<16> sum = 0;
  for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE
    pixel_t p = in.read();
    sum += p;
    lines.write(p);
  }
  sums.write(sum);
}

class smoother {
 public:
  void run(hls::stream<pixel_t>& lines, hls::stream<pixel_t>& smooth, int length, bool on) {
    for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE
      pixel_t p = lines.read();
      smooth.write(on ? pixel_t((ap_uint<10>(p) + before + 1) >> 1) : p);
      before = p;
    }
  }

 private:
  pixel_t before = 0;
};

static void last(hls::stream<pixel_t>& smooth, hls::stream<pixel_t>& out, int length) {
  for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE
    out.write(~smooth.read());
  }
}

static void report(hls::stream<ap_uint<16>>& sums, hls::stream<ap_uint<16>>& means, ap_uint<2> rate, int frame) {
  ap_uint<16> sum = sums.read();
  if (frame % (rate + 1) == 0) means.write(sum >> 2);
}

static void skip(hls::stream<ap_uint<16>>& rest, hls::stream<ap_uint<16>>& spare) { spare.write(rest.read()); }

void dataflow_frames(hls::stream<pixel_t>& in, hls::stream<pixel_t>& out, hls::stream<ap_uint<16>>& means,
                     hls::stream<ap_uint<16>>& rest, hls::stream<ap_uint<16>>& spare, ap_uint<3> frames,
                     ap_uint<5> length, bool on, ap_uint<2> rate) {
  static smoother s;
  for (int frame = 0; frame < frames; frame++) {
#pragma HLS DATAFLOW
    hls::stream<pixel_t> lines("lines"), smooth("smooth");
    hls::stream<ap_uint<16>> sums("sums");
    first(in, lines, sums, length);
    s.run(lines, smooth, length, on);
    last(smooth, out, length);
    report(sums, means, rate, frame);
    if (on && frame < 2) skip(rest, spare);
  }
}
