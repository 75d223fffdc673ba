#include "ap_int.h"
#include "hls_stream.h"

void nonblocking_read(hls::stream<int>& in, hls::stream<int>& out) {
  int x = 0;
  if (in.read_nb(x)) out.write(x);  // refused: non-blocking
}
