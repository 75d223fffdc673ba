#include "ap_fixed.h"
#include "hls_stream.h"

void fixed_point_at_run_time(hls::stream<int>& in, hls::stream<ap_fixed<16, 8>>& out) {
  out.write(ap_fixed<16, 8>(in.read() * 0.5));  // refused: floating point
}
