#include "hls_stream.h"

float returns_floating_point(hls::stream<int>& in) {  // refused: floating point
  return 0.5f * in.read();
}
