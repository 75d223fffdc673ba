#include "ap_int.h"
#include "hls_stream.h"

void interface_block_memory(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS INTERFACE mode = bram port = in  // refused: bram
  out.write(in.read());
}
