#include "ap_int.h"
#include "hls_stream.h"

void uninitialised_always(hls::stream<int>& in, hls::stream<int>& out) {
  int bias;
  out.write(in.read() + bias);  // refused: bias
}
