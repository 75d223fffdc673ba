#include "hls_stream.h"

static void sum(hls::stream<int>& in, hls::stream<int>& more, hls::stream<int>& out) {
  out.write(in.read() + more.read());
}
static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void dataflow_never_written(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> low;
  hls::stream<int> more;  // refused: the stream 'more' is read by the process .* and never written
  copy(in, low);
  sum(low, more, out);
}
