#include "ap_int.h"
#include "hls_stream.h"

void index_past_the_end(hls::stream<int>& in, hls::stream<int>& out) {
  static int taps[4];
  taps[3] = taps[2];
  taps[2] = in.read();
  out.write(taps[4]);  // refused: past the end|outside|taps
}
