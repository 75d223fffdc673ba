#include "ap_int.h"
#include "hls_stream.h"

void double_precision(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  const double y = x;                        // refused: double|float
  out.write(static_cast<int>(y * y / 3.0));  // refused: double|float
}
