#include "ap_int.h"
#include "hls_stream.h"

void pointer_payload(hls::stream<int*>& in, hls::stream<int>& out) {
  out.write(*in.read());  // refused: pointer
}
