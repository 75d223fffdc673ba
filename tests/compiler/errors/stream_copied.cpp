#include "ap_int.h"
#include "hls_stream.h"

void stream_copied(hls::stream<int>& in, hls::stream<int>& out) {
  hls::stream<int> copy = in;  // refused: stream
  out.write(copy.read());
}
