// A chain of four stages over AXI4-Stream beats, whose sidebands travel through the internal streams. The stages stand
// in a function of their own, as an accelerator inside of a wrapper does.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<24, 1, 2, 3> beat_t;

static void strip_header(hls::stream<beat_t>& in, hls::stream<beat_t>& body, hls::stream<ap_uint<8>>& keys) {
  beat_t header = in.read();
  keys.write(header.data.range(7, 0));
  bool last = header.last;
  body.write(header);
  while (!last) {
#pragma HLS PIPELINE
    beat_t b = in.read();
    last = b.last;
    body.write(b);
  }
}

static void scramble(hls::stream<beat_t>& body, hls::stream<ap_uint<8>>& keys, hls::stream<beat_t>& coded) {
  ap_uint<8> key = keys.read();
  bool last = false;
  while (!last) {
#pragma HLS PIPELINE
    beat_t b = body.read();
    last = b.last;
    b.data = b.data ^ (key, key, key);
    key = (key.range(6, 0), key[7] ^ key[5] ^ key[4] ^ key[3]);
    coded.write(b);
  }
}

static void checksum(hls::stream<beat_t>& coded, hls::stream<beat_t>& checked, hls::stream<ap_uint<24>>& sums) {
  ap_uint<24> sum = 0;
  bool last = false;
  while (!last) {
#pragma HLS PIPELINE
    beat_t b = coded.read();
    last = b.last;
    sum ^= b.data;
    sum = (sum.range(22, 0), sum[23]);
    checked.write(b);
  }
  sums.write(sum);
}

static void append(hls::stream<beat_t>& checked, hls::stream<ap_uint<24>>& sums, hls::stream<beat_t>& out) {
  bool last = false;
  beat_t b;
  while (!last) {
#pragma HLS PIPELINE
    b = checked.read();
    last = b.last;
    b.last = 0;
    out.write(b);
  }
  b.data = sums.read();
  b.last = 1;
  out.write(b);
}

static void accelerator(hls::stream<beat_t>& in, hls::stream<beat_t>& out) {
#pragma HLS DATAFLOW
  hls::stream<beat_t> body("body"), coded("coded"), checked("checked");
  hls::stream<ap_uint<8>> keys("keys");
  hls::stream<ap_uint<24>> sums("sums");
  strip_header(in, body, keys);
  scramble(body, keys, coded);
  checksum(coded, checked, sums);
  append(checked, sums, out);
}

void dataflow_packets(hls::stream<beat_t>& in, hls::stream<beat_t>& out) {
#pragma HLS INTERFACE axis port = in
#pragma HLS INTERFACE axis port = out
#pragma HLS INTERFACE ap_ctrl_none port = return
  accelerator(in, out);
}
