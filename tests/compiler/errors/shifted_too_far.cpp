#include "ap_int.h"
#include "hls_stream.h"

void shifted_too_far(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() << 40);  // refused: shift
}
