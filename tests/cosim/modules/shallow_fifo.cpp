// Sends all of a call's tokens one way before the first one the other way: the first stream must hold them all, and has
// two places. Short calls fit into what every process has beside.
#include <ap_int.h>
#include <hls_stream.h>

typedef ap_uint<8> token_t;

static void send(hls::stream<token_t>& in, hls::stream<token_t>& early, hls::stream<token_t>& late, ap_uint<8> count) {
  for (unsigned i = 0; i < count; ++i) {
#pragma HLS PIPELINE
    early.write(in.read());
  }
  for (unsigned i = 0; i < count; ++i) {
#pragma HLS PIPELINE
    late.write(i);
  }
}

static void meet(hls::stream<token_t>& early, hls::stream<token_t>& late, hls::stream<token_t>& out, ap_uint<8> count) {
  for (unsigned i = 0; i < count; ++i) {
#pragma HLS PIPELINE
    out.write(early.read() + late.read());
  }
}

void shallow_fifo(hls::stream<token_t>& in, hls::stream<token_t>& out, ap_uint<8> count) {
#pragma HLS DATAFLOW
  hls::stream<token_t, 2> early("early");
  hls::stream<token_t> late("late");
  send(in, early, late, count);
  meet(early, late, out, count);
}
