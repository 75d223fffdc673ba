#include "ap_int.h"
#include "hls_stream.h"

void divided_by_zero(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() / 0);  // refused: division by zero
}
