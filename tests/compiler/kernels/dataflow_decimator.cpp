// Different rates: words of four bytes are taken apart, every third byte of the smoothed stream is kept, and pairs of
// them are put together. No scalars: it runs packet after packet, ended by `last`.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<32, 0, 0, 0> word_t;
struct byte_t {
  ap_uint<8> value;
  bool last;
};

template <int LANES>
static void take_apart(hls::stream<word_t>& in, hls::stream<byte_t>& bytes) {
  bool last = false;
  while (!last) {
    word_t word = in.read();
    last = word.last;
    for (int lane = 0; lane < LANES; lane++) {
#pragma HLS PIPELINE
      byte_t b;
      b.value = word.data.range(8 * lane + 7, 8 * lane);
      b.last = last && lane == LANES - 1;
      bytes.write(b);
    }
  }
}

static void smooth_and_drop(hls::stream<byte_t>& bytes, hls::stream<byte_t>& kept) {
  ap_uint<8> before = 0;
  ap_uint<2> phase = 0;
  bool last = false;
  while (!last) {
#pragma HLS PIPELINE
    byte_t b = bytes.read();
    last = b.last;
    byte_t k;
    k.value = (ap_uint<9>(b.value) + before) >> 1;
    k.last = last;
    if (phase == 0 || last) kept.write(k);
    before = b.value;
    phase = phase == 2 ? ap_uint<2>(0) : ap_uint<2>(phase + 1);
  }
}

static void pair_up(hls::stream<byte_t>& kept, hls::stream<ap_uint<17>>& out) {
  bool last = false;
  while (!last) {
#pragma HLS PIPELINE
    byte_t low = kept.read();
    byte_t high = low;
    last = low.last;
    if (!last) {
      high = kept.read();
      last = high.last;
    }
    out.write((ap_uint<1>(last), high.value, low.value));
  }
}

void dataflow_decimator(hls::stream<word_t>& in, hls::stream<ap_uint<17>>& out) {
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS DATAFLOW
  static hls::stream<byte_t> bytes("bytes");
  static hls::stream<byte_t> kept("kept");
#pragma HLS STREAM variable = kept depth = 3
  take_apart<4>(in, bytes);
  smooth_and_drop(bytes, kept);
  pair_up(kept, out);
}
