#include "ap_int.h"
#include "hls_stream.h"

void much_wider_than_any(hls::stream<ap_uint<20000000>>& in, hls::stream<int>& out) {
  out.write(in.read() != 0);  // refused: at most 65536 bits
}
