#include "hls_stream.h"

static void copy(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }
static void add(hls::stream<int>& in, hls::stream<int>& out, int gain) {
  if (!in.empty()) out.write(in.read() + gain);  // refused: results depend on timing in a process that takes scalars
}

void asks_with_arguments(hls::stream<int>& in, hls::stream<int>& out, int gain) {
#pragma HLS DATAFLOW
  static hls::stream<int> between;
  copy(in, between);
  add(between, out, gain);
}
