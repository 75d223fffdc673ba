// Two ways of very different length between fork and join, at a token a clock: the short one must hold what the divider
// has under way. Nothing in the source says how much.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<16> value_t;

static void fork(hls::stream<value_t>& in, hls::stream<value_t>& straight, hls::stream<value_t>& divided) {
  value_t v = in.read();
  straight.write(v);
  divided.write(v);
}

static void divide(hls::stream<value_t>& in, hls::stream<value_t>& out) {
  value_t v = in.read();
  out.write(value_t(50000) / (v | 1));
}

static void join(hls::stream<value_t>& straight, hls::stream<value_t>& divided, hls::stream<ap_uint<17>>& out) {
  out.write(straight.read() + divided.read());
}

void dataflow_balanced(hls::stream<value_t>& in, hls::stream<ap_uint<17>>& out) {
#pragma HLS DATAFLOW
  hls::stream<value_t> straight, to_divide, quotients;
  fork(in, straight, to_divide);
  divide(to_divide, quotients);
  join(straight, quotients, out);
}
