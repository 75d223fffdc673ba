#include "ap_int.h"
#include "hls_stream.h"

void rvalue_parameter(hls::stream<int>& in, hls::stream<int>& out, int&& bias) {  // refused: 'bias'|parameter
  out.write(in.read() + bias);
}
