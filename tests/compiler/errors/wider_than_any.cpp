#include "ap_int.h"
#include "hls_stream.h"

void wider_than_any(hls::stream<ap_uint<70000>>& in, hls::stream<ap_uint<70000>>& out) {
  out.write(in.read());  // refused: bits
}
