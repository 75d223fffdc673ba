#include "ap_int.h"
#include "hls_stream.h"

void integer_of_no_bits(hls::stream<ap_uint<0>>& in, hls::stream<ap_uint<8>>& out) {
  out.write(in.read());  // refused: width|bits
}
