#include "ap_int.h"
#include "hls_stream.h"

// A loop without an end and without a stream: the second token would never be read.
void unbounded_loop(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& out) {
  static ap_uint<32> total = 0;
  out.write(in.read());
  for (;;) {     // refused: loop
    total += 3;  // refused: loop
  }
}
