#include "ap_int.h"
#include "hls_stream.h"

void computed_goto(hls::stream<int>& in, hls::stream<int>& out) {
  static void* const targets[2] = {&&first, &&second};
  const int x = in.read();
  goto* targets[x & 1];  // refused: goto
first:
  out.write(x);
  return;
second:
  out.write(-x);
}
