#include <cstring>

#include "hls_stream.h"

void float_bits(hls::stream<unsigned>& in, hls::stream<unsigned>& out) {
  const unsigned bits = in.read();
  float value;
  std::memcpy(&value, &bits, sizeof value);
  out.write(value > 1.5f ? 1 : 0);  // refused: floating point
}
