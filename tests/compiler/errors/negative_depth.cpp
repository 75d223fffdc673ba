#include "ap_int.h"
#include "hls_stream.h"

void negative_depth(hls::stream<int, -2>& in, hls::stream<int>& out) {
  out.write(in.read());  // refused: depth
}
