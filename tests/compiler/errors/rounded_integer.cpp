#include "ap_int.h"
#include "hls_math.h"
#include "hls_stream.h"

void rounded_integer(hls::stream<ap_int<8>>& in, hls::stream<ap_int<8>>& out) {
  out.write(hls::floor(in.read()));  // refused: only ap_fixed and ap_ufixed have something to round
}
