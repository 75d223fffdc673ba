#include <cmath>

#include "hls_stream.h"

void library_loop(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(static_cast<int>(std::floor(std::pow(in.read(), 2))));  // refused: 'pow'
}
