#include "ap_int.h"
#include "hls_stream.h"

static void first(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 1); }
static void second(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() * 2); }

void pragma_dataflow(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW  // refused: DATAFLOW
  hls::stream<int, 2> between;
  first(in, between);
  second(between, out);
}
