#include "ap_int.h"
#include "hls_stream.h"

void nonblocking_read(hls::stream<int>& in, hls::stream<int>& out) {
  int x = 0;
  if (!in.read_nb(x)) x = -1;  // refused: non-blocking
  out.write(x);
}
