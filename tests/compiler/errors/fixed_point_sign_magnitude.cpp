#include "ap_fixed.h"
#include "hls_stream.h"

typedef ap_fixed<16, 8, AP_TRN, AP_WRAP_SM> number;

void fixed_point_sign_magnitude(hls::stream<number>& in, hls::stream<number>& out) {
  out.write(in.read() * number(2));  // refused: AP_WRAP_SM
}
