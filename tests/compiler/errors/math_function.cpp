#include <cmath>

#include "hls_stream.h"

void math_function(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(static_cast<int>(std::sqrt(in.read())));  // refused: sqrt|double|float
}
