#include "ap_int.h"
#include "hls_stream.h"

// A loop that runs for ever and does nothing anyone could see.
void unbounded_loop(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
  ap_uint<8> x = in.read();
  while (x != 0) {  // refused: loop
    x = x;
  }
  out.write(x);
}
