// One function called twice, scalars that the top computes first, a result by reference, a constant loop of calls.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_uint<12> value_t;

static void source(hls::stream<value_t>& in, hls::stream<value_t>& first, int length) {
  for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE
    first.write(in.read());
  }
}

static void add(hls::stream<value_t>& in, hls::stream<value_t>& out, int length, const value_t& amount) {
  value_t running = amount;
  for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE
    running += in.read();
    out.write(running);
  }
}

static void sink(hls::stream<value_t>& in, hls::stream<value_t>& out, int length, ap_uint<12>& largest) {
  value_t most = 0;
  for (int i = 0; i < length; i++) {
#pragma HLS PIPELINE
    value_t v = in.read();
    if (v > most) most = v;
    out.write(v);
  }
  largest = most;
}

void dataflow_twice(hls::stream<value_t>& in, hls::stream<value_t>& out, ap_uint<5> rows, ap_uint<5> columns,
                    ap_uint<12> amount, ap_uint<12>& largest) {
#pragma HLS DATAFLOW
  hls::stream<value_t> between[4];
#pragma HLS STREAM variable = between depth = 3
  const int length = rows * columns;
  value_t half = amount > 100 ? value_t(amount / 2) : amount;
  source(in, between[0], length);
  for (int i = 0; i < 2; i++) {
#pragma HLS UNROLL
    add(between[i], between[i + 1], length, half + i);
  }
  add(between[2], between[3], length, 7);
  sink(between[3], out, length, largest);
}
