#include "ap_int.h"
#include "hls_stream.h"

void interface_without_mode(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS INTERFACE port = in  // refused: mode
  out.write(in.read());
}
