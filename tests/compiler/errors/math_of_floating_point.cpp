#include "hls_math.h"
#include "hls_stream.h"

void math_of_floating_point(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(int(hls::sqrt(float(in.read()))));  // refused: floating point is not supported: use ap_fixed
}
