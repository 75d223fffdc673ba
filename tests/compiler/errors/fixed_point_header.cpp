#include "ap_fixed.h"  // refused: ap_fixed
#include "hls_stream.h"

void fixed_point_header(hls::stream<ap_fixed<16, 8>>& in, hls::stream<ap_fixed<16, 8>>& out) {
  out.write(in.read() * ap_fixed<16, 8>(0.5));
}
