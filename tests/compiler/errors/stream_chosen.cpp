#include "ap_int.h"
#include "hls_stream.h"

void stream_chosen(hls::stream<int>& a, hls::stream<int>& b, hls::stream<int>& out) {
  const int x = a.read();
  hls::stream<int>& chosen = (x & 1) ? a : b;
  out.write(chosen.read());  // refused: stream
}
