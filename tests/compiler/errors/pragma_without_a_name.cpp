#include "ap_int.h"
#include "hls_stream.h"

void pragma_without_a_name(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS  // refused: name
  out.write(in.read());
}
