#include "ap_int.h"
#include "hls_stream.h"

void does_not_compile(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
  out.write(in.read() + undeclared_name);  // refused: use of undeclared identifier 'undeclared_name'
}
