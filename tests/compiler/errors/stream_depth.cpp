#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void stream_depth(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
#pragma HLS STREAM variable = between depth = 2000000  // refused: the depth is not a number from 1 to 1048576
  copy(in, between);
  copy(between, out);
}
