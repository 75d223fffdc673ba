#include "hls_stream.h"

static void count(hls::stream<int>& in, hls::stream<int>& out) {
  static int seen = 0;
  seen += 1;                    // refused: 'seen' is written by the process 'count' and used by the process 'count'
  out.write(in.read() + seen);  // refused: 'seen' is written by the process 'count' and used by the process 'count'
}

void dataflow_static(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  count(in, between);
  count(between, out);
}
