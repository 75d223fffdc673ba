#include "hls_stream.h"

// options: --axi-lite
static void add(hls::stream<int>& in, hls::stream<int>& out, int amount) { out.write(in.read() + amount); }

typedef hls::stream<int> stream_t;

void dataflow_axi_lite(stream_t& in, stream_t& out, int amount) {  // refused: --axi-lite: .* is made of processes
#pragma HLS DATAFLOW
  stream_t between;
  add(in, between, amount);
  add(between, out, amount);
}
