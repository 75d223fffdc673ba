#include <stdexcept>

#include "hls_stream.h"

void caught(hls::stream<int>& in, hls::stream<int>& out) {
  try {  // refused: exceptions
    const int x = in.read();
    if (x < 0) throw std::runtime_error("negative");  // refused: exceptions
    out.write(x);
  } catch (const std::runtime_error&) {
    out.write(0);
  }
}
