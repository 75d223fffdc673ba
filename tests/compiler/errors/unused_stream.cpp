#include "ap_int.h"
#include "hls_stream.h"

void unused_stream(hls::stream<int>& in, hls::stream<int>& spare, hls::stream<int>& out) {  // refused: 'spare'
  out.write(in.read());
}
