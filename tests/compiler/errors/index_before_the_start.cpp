#include "ap_int.h"
#include "hls_stream.h"

void index_before_the_start(hls::stream<int>& in, hls::stream<int>& out) {
  static int taps[4];
  taps[0] = in.read();
  for (int i = 0; i < 4; ++i) taps[i] = taps[i - 1];  // refused: outside|before
  out.write(taps[3]);
}
