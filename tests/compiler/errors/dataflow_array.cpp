#include "hls_stream.h"

static void fill(hls::stream<int>& in, int (&frame)[64]) {
  for (int i = 0; i < 64; ++i) {
#pragma HLS PIPELINE
    frame[i] = in.read();
  }
}
static void drain(const int (&frame)[64], hls::stream<int>& out) {
  for (int i = 0; i < 64; ++i) {
#pragma HLS PIPELINE
    out.write(frame[63 - i]);
  }
}

void dataflow_array(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  int frame[64];
  fill(in, frame);
  drain(frame, out);  // refused: 'frame' is written by the process 'fill' and used by the process 'drain'
}
