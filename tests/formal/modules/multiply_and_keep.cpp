// Every product is needed by the next iteration, which therefore comes two clocks later; a token goes out in some
// iterations only.
#include "ap_int.h"
#include "hls_stream.h"

void multiply_and_keep(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<16>>& out) {
#pragma HLS PIPELINE II = 2
  static ap_uint<16> state = 1;
  const ap_uint<8> value = in.read();
  if (value[0]) {
    state = state * value + 3;
  } else {
    out.write(state ^ value);
  }
}
